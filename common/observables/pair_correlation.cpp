#include "common/observables/pair_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/neighbors.hpp"

namespace softgrain {

Histogram pair_correlation(std::span<const Vec2> position, const Box& box, double bin, double reach) {
    if (position.size() < 2) return {};
    Vec2 low = position.front(), high = low;
    for (const Vec2& x : position) {
        low = low.cwiseMin(x);
        high = high.cwiseMax(x);
    }
    const Vec2 sides = high - low;
    const double side = box.periodic ? box.spacing() : sides.minCoeff();
    const double area = box.periodic ? box.area() : sides.prod();
    const auto bins = static_cast<std::size_t>(std::min(reach, 0.5 * side) / bin);
    if (bins == 0) return {};
    Histogram result{bin, std::vector<double>(bins, 0.0)};

    // Neighbours are those of discs that are half as large as the reach.
    const double far = bin * static_cast<double>(bins);
    constexpr double skin = 1e-6;
    const std::vector<double> discs(position.size(), 0.5 * far * (1.0 - skin));
    NeighborList near;
    near.build(position, discs, skin * far, box.periodic ? box.reduced() : box);
    for (std::size_t k = 0; k < near.pairs().size(); ++k) {
        const Pair& pair = near.pairs()[k];
        Vec2 d = position[static_cast<std::size_t>(pair.j)] - position[static_cast<std::size_t>(pair.i)];
        if (box.periodic) d += box.reduced().image(near.images()[k]);
        const double r = d.norm();
        const auto b = static_cast<std::size_t>(r / bin);
        if (b >= bins) continue;
        const double window =
            box.periodic ? area : (sides.x() - std::abs(d.x())) * (sides.y() - std::abs(d.y()));
        result.value[b] += 1.0 / window;
    }
    // Pairs expected in a ring without order, each pair counted once.
    const double n = static_cast<double>(position.size());
    for (std::size_t b = 0; b < bins; ++b) {
        const double inner = static_cast<double>(b) * bin, outer = inner + bin;
        const double ring = std::numbers::pi * (outer * outer - inner * inner);
        result.value[b] *= area * area / (0.5 * n * (n - 1.0) * ring);
    }
    return result;
}

}  // namespace softgrain
