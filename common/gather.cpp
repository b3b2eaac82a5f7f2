#include "common/gather.hpp"

namespace softgrain {

void PairsOfGrain::build(std::span<const Pair> pairs, std::size_t grains) {
    start_.assign(grains + 1, 0);
    for (const Pair& p : pairs) {
        ++start_[static_cast<std::size_t>(p.i) + 1];
        ++start_[static_cast<std::size_t>(p.j) + 1];
    }
    for (std::size_t g = 0; g < grains; ++g) start_[g + 1] += start_[g];
    entries_.resize(2 * pairs.size());
    std::vector<std::size_t> fill(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        entries_[fill[static_cast<std::size_t>(pairs[k].i)]++] = {static_cast<int>(k), false};
        entries_[fill[static_cast<std::size_t>(pairs[k].j)]++] = {static_cast<int>(k), true};
    }
}

}  // namespace softgrain
