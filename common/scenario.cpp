#include "common/scenario.hpp"

#include <algorithm>

namespace softgrain {

bool Scenario::has_ellipses() const {
    return std::any_of(classes.begin(), classes.end(),
                       [](const GrainClass& c) { return c.aspect_ratio > 1.0; });
}

}  // namespace softgrain
