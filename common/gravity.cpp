#include "common/gravity.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"

namespace softgrain {

Vec2 gravity_of(const Scenario& scenario, const Packing& packing) {
    const Vec2& g = scenario.box.gravity;
    if (packing.box.periodic && !g.isZero(0.0))
        throw InputError(
            fmt::format("box.gravity_x = {}, box.gravity_y = {} need walls that carry the weight; set "
                        "box.periodic = false, or both to 0",
                        g.x(), g.y()));
    return g;
}

}  // namespace softgrain
