#include "common/packing/fill_region.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "common/errors.hpp"
#include "common/packing/packing_request.hpp"
#include "common/packing/placed_discs.hpp"
#include "common/packing/random_sequential.hpp"

namespace softgrain {
namespace {

constexpr int most_trials = 1'000'000;  // for one disc

double area_of(const PackingRegion& region) {
    return region.radius > 0.0 ? std::numbers::pi * region.radius * region.radius : region.size.prod();
}

/// Of a disc that fits, so that it lies inside.
Vec2 center_in(const PackingRegion& region, double radius, Random& random) {
    if (region.radius > 0.0) {
        const double way = (region.radius - radius) * std::sqrt(random.between(0.0, 1.0));
        const double angle = random.between(0.0, 2.0 * std::numbers::pi);
        return region.center + way * Vec2{std::cos(angle), std::sin(angle)};
    }
    const Vec2 half = 0.5 * region.size - Vec2::Constant(radius);
    const double x = random.between(-half.x(), half.x());
    return region.center + Vec2{x, random.between(-half.y(), half.y())};
}

}  // namespace

Packing fill_region(const std::vector<double>& radii, const PackingRegion& region, const Box& box,
                    Random& random) {
    Packing packing{
        .box = box, .center = std::vector<Vec2>(radii.size(), Vec2::Zero()), .radius = radii, .frame = {}};
    const double largest = region.radius > 0.0 ? region.radius : 0.5 * region.size.minCoeff();
    PlacedDiscs placed(box, 2.0 * packing.mean_radius());
    double area = 0.0;
    for (const std::size_t disc : largest_first(radii)) {
        const double r = radii[disc];
        bool found = false;
        for (int trial = 0; trial < most_trials && r < largest && !found; ++trial) {
            packing.center[disc] = center_in(region, r, random);
            found = !placed.overlaps(packing.center[disc], r);
        }
        if (!found)
            throw InputError(
                fmt::format("packing.count = {} grains have no room in packing.region: they would fill "
                            "{:.3f} of it, and at "
                            "random places {:.3f} went in; make the region larger or take fewer",
                            radii.size(), disc_area(radii) / area_of(region), area / area_of(region)));
        placed.add(packing.center[disc], r);
        area += std::numbers::pi * r * r;
    }
    return packing;
}

}  // namespace softgrain
