#pragma once
// The shape of rigid clusters (clumps) of discs, in units of the grain's size.
#include <span>
#include <string>
#include <vector>

#include "common/disc.hpp"

namespace softgrain {

inline constexpr std::size_t most_discs_of_a_clump = 64;

/// Lengths in units of the radius of the disc of the same area, so that the area is pi; the centroid lies at
/// the origin.
struct ClumpShape {
    std::vector<Disc> discs;
    double reach = 0.0;         ///< radius of the disc about the centroid that holds all of it
    double polar_moment = 0.0;  ///< integral of the squared distance from the centroid
    std::vector<Vec2> outline;  ///< closed polygon, counter-clockwise
};

/// Of discs given in any unit, see clump_fault. Mass is spread evenly over the union of the discs.
ClumpShape clump_shape(std::span<const Disc> discs);

/// What keeps discs from being a clump and what to do about it, or "": all must show, hang together, and
/// enclose no hole.
std::string clump_fault(std::span<const Disc> discs);

/// `count` equal discs evenly along x, their union `elongation` times as long as it is wide.
std::vector<Disc> discs_in_line(std::size_t count, double elongation);

}  // namespace softgrain
