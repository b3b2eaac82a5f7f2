#pragma once
// Area, moments and boundary of the union of discs, exact: Green's theorem over the arcs of its boundary.
#include <cstddef>
#include <span>
#include <vector>

#include "common/disc.hpp"

namespace softgrain {

/// Part of the boundary, counter-clockwise about the disc; to - from is 2 pi for a whole circle.
struct Arc {
    std::size_t disc;
    double from, to;  ///< [rad]
};

/// What of the discs' circles lies in no other disc, disc by disc.
std::vector<Arc> boundary_arcs(std::span<const Disc> discs);

/// The arcs in the order in which they follow each other along each closed curve of the boundary. One curve
/// means that the discs hang together and enclose no hole.
std::vector<std::vector<Arc>> boundary_curves(std::span<const Disc> discs);

struct UnionMoments {
    double area = 0.0;             ///< [m^2]
    Vec2 centroid = Vec2::Zero();  ///< [m]
    double polar_moment = 0.0;     ///< integral of the squared distance from the centroid [m^4]
};
UnionMoments union_moments(std::span<const Disc> discs);

}  // namespace softgrain
