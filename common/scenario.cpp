#include "common/scenario.hpp"

#include <algorithm>

namespace softgrain {

bool Scenario::has_ellipses() const {
    return std::any_of(classes.begin(), classes.end(),
                       [](const GrainClass& c) { return c.aspect_ratio > 1.0; });
}

bool Scenario::has_clumps() const {
    return std::any_of(classes.begin(), classes.end(), [](const GrainClass& c) { return !c.clump.empty(); });
}

std::vector<std::size_t> stage_order(const std::vector<LoadingStage>& loading) {
    std::vector<std::size_t> order;
    for (std::size_t k = 0; k < loading.size(); ++k) {
        if (loading[k].kind != LoadingKind::repeat) {
            order.push_back(k);
            continue;
        }
        for (int time = 0; time < loading[k].times; ++time)
            for (std::size_t back = k - static_cast<std::size_t>(loading[k].stages); back < k; ++back)
                order.push_back(back);
    }
    return order;
}

}  // namespace softgrain
