#pragma once
// Discs thrown at random into a circle, none on another.
#include <span>
#include <vector>

#include "bpm/disc_sizes.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// Places for discs of these radii, the largest thrown first, in a circle about the origin whose area is that
/// of the discs / fraction; it grows where they do not fit. fraction < 0.5. Throws StopAsked.
std::vector<Vec2> scatter_in_circle(std::span<const double> radius, double fraction, Random& random);

}  // namespace softgrain::bpm
