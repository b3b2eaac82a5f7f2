#include "common/packing/clump_shape.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/packing/disc_union.hpp"

namespace softgrain {
namespace {

constexpr double nodes_per_circle = 48.0;

std::vector<Vec2> outline_of(std::span<const Disc> discs) {
    std::vector<Vec2> outline;
    for (const auto& curve : boundary_curves(discs))
        for (const Arc& arc : curve) {
            const double angle = arc.to - arc.from;
            const double nodes = std::ceil(nodes_per_circle * angle / (2.0 * std::numbers::pi));
            for (double k = 0.0; k < nodes; k += 1.0) {
                const double at = arc.from + angle * k / nodes;
                outline.push_back(discs[arc.disc].center +
                                  discs[arc.disc].radius * Vec2{std::cos(at), std::sin(at)});
            }
        }
    return outline;
}

}  // namespace

ClumpShape clump_shape(std::span<const Disc> discs) {
    const UnionMoments moments = union_moments(discs);
    const double size = std::sqrt(moments.area / std::numbers::pi);
    ClumpShape shape;
    for (const Disc& disc : discs) {
        shape.discs.push_back({(disc.center - moments.centroid) / size, disc.radius / size});
        shape.reach = std::max(shape.reach, shape.discs.back().center.norm() + shape.discs.back().radius);
    }
    shape.polar_moment = moments.polar_moment / (size * size * size * size);
    shape.outline = outline_of(shape.discs);
    return shape;
}

std::string clump_fault(std::span<const Disc> discs) {
    if (discs.empty() || discs.size() > most_discs_of_a_clump)
        return fmt::format("must have 1 to {} discs, got {}", most_discs_of_a_clump, discs.size());
    for (std::size_t i = 0; i < discs.size(); ++i)
        if (!(discs[i].radius > 0.0) || !std::isfinite(discs[i].radius) || !discs[i].center.allFinite())
            return fmt::format("needs finite places and radii > 0, disc {} has not: give x y r", i);
    const std::vector<Arc> arcs = boundary_arcs(discs);
    for (std::size_t i = 0; i < discs.size(); ++i)
        if (std::none_of(arcs.begin(), arcs.end(), [&](const Arc& arc) { return arc.disc == i; }))
            return fmt::format("has disc {} inside the others: leave it out", i);
    if (const std::size_t curves = boundary_curves(discs).size(); curves > 1)
        return fmt::format(
            "must be one piece without holes, but its boundary has {} curves: let the discs overlap each "
            "other, and fill holes with a disc",
            curves);
    return {};
}

std::vector<Disc> discs_in_line(std::size_t count, double elongation) {
    std::vector<Disc> discs;
    const double spacing = count > 1 ? 2.0 * (elongation - 1.0) / (static_cast<double>(count) - 1.0) : 0.0;
    for (std::size_t k = 0; k < count; ++k)
        discs.push_back(
            {{spacing * (static_cast<double>(k) - 0.5 * (static_cast<double>(count) - 1.0)), 0.0}, 1.0});
    return discs;
}

}  // namespace softgrain
