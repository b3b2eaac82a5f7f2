#include "common/packing/random_sequential.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "common/errors.hpp"
#include "common/packing/placed_discs.hpp"
#include "common/stop.hpp"

namespace softgrain {
namespace {

constexpr int most_trials = 1'000'000;  // for one disc

/// Of the centre of a disc, along one axis.
double coordinate(double radius, double length, bool periodic, Random& random) {
    return periodic ? random.between(0.0, length) : random.between(radius, length - radius);
}

[[noreturn]] void fail(const PackingRequest& request, const Box& box, double area) {
    throw InputError(fmt::format(
        "packing.packing_fraction {} cannot be reached by random places: there was no room left at "
        "{:.4f}; lower it or use another packing.generator",
        request.disc_fraction_or(0.0) * request.grain_share, area / box.area() * request.grain_share));
}

}  // namespace

std::vector<std::size_t> largest_first(const std::vector<double>& radii) {
    std::vector<std::size_t> order(radii.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return radii[a] > radii[b]; });
    return order;
}

Packing random_sequential(const std::vector<double>& radii, const PackingRequest& request, Random& random) {
    const double fraction = request.disc_fraction_or(1.0);
    const Box box = request.box_for(radii, fraction);
    const double mean = std::accumulate(radii.begin(), radii.end(), 0.0) / static_cast<double>(radii.size());
    Packing packing{
        .box = box, .center = std::vector<Vec2>(radii.size(), Vec2::Zero()), .radius = radii, .frame = {}};
    PlacedDiscs placed(box, 2.0 * mean);
    double area = 0.0;
    for (const std::size_t disc : largest_first(radii)) {
        heed_stop();
        const double r = radii[disc];
        if (2.0 * r > std::min(box.width(), box.height())) fail(request, box, area);
        Vec2& center = packing.center[disc];
        bool found = false;
        for (int trial = 0; trial < most_trials && !found; ++trial) {
            const double x = coordinate(r, box.width(), box.periodic, random);
            center = {x, coordinate(r, box.height(), box.periodic, random)};
            found = !placed.overlaps(center, r);
        }
        if (!found) fail(request, box, area);
        placed.add(center, r);
        area += std::numbers::pi * r * r;
    }
    return packing;
}

}  // namespace softgrain
