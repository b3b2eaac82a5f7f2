#include "common/packing/driven_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/packing/packing_csv.hpp"

namespace softgrain {
namespace {

/// Fewest discs whose neighbours are no further apart than this.
std::size_t discs_on(double length, double distance) {
    constexpr double rounding = 1e-9;
    return static_cast<std::size_t>(std::ceil(length / distance - rounding));
}

std::vector<Vec2> centers_of(const DrivenGrains& driven) {
    const double distance = 2.0 * driven.disc_radius * driven.spacing;
    std::vector<Vec2> centers;
    if (driven.ring) {
        const std::size_t count =
            std::max<std::size_t>(1, discs_on(2.0 * std::numbers::pi * driven.radius, distance));
        for (std::size_t k = 0; k < count; ++k) {
            const double angle = 2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count);
            centers.emplace_back(driven.center + driven.radius * Vec2{std::cos(angle), std::sin(angle)});
        }
        return centers;
    }
    const Vec2 way = driven.to - driven.from;
    const std::size_t gaps = discs_on(way.norm(), distance);
    for (std::size_t k = 0; k <= gaps; ++k)
        centers.emplace_back(driven.from +
                             way * (gaps > 0 ? static_cast<double>(k) / static_cast<double>(gaps) : 0.0));
    return centers;
}

void check_room(const Packing& packing, std::size_t grains, std::size_t number) {
    for (std::size_t d = packing.free_size(); d < packing.size(); ++d)
        for (std::size_t g = 0; g < grains; ++g) {
            const double gap =
                (packing.center[d] - packing.center[g]).norm() - packing.radius[d] - packing.reach(g);
            if (gap < -tolerated_overlap * std::min(packing.radius[d], packing.radius[g]))
                throw InputError(fmt::format(
                    "driven.{} lies on grain {} of the packing: they overlap by {:.3g} m; move it or make "
                    "packing.region smaller",
                    number, g, -gap));
        }
}

}  // namespace

void add_driven_grains(const Scenario& scenario, Packing& packing) {
    if (scenario.driven.empty()) return;
    if (packing.box.periodic)
        throw InputError("[[driven]] grains need a box with walls; set box.periodic = false");
    const std::size_t grains = packing.size();
    const Vec2 corner = packing.box.origin();
    for (std::size_t k = 0; k < scenario.driven.size(); ++k) {
        const DrivenGrains& driven = scenario.driven[k];
        DrivenMotion motion{corner + driven.center, driven.spin, driven.velocity};
        for (const Vec2& center : centers_of(driven)) {
            packing.center.emplace_back(corner + center);
            packing.radius.push_back(driven.disc_radius);
            packing.driven.push_back(motion);
            if (!packing.grain_class.empty()) packing.grain_class.push_back(0);
            if (!packing.aspect_ratio.empty()) {
                packing.aspect_ratio.push_back(1.0);
                packing.angle.push_back(0.0);
            }
            if (!packing.frame.empty()) packing.frame.emplace_back(Mat2::Identity());
        }
        check_room(packing, grains, k);
    }
}

}  // namespace softgrain
