#pragma once
// Discs that fall into a box.
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/packing_request.hpp"
#include "common/packing/random.hpp"

namespace softgrain {

/// Frictionless discs fall from loose random places between two walls onto the bottom, by Box2D (single
/// precision), until they rest; then the overlaps that Box2D tolerates are removed in double precision, under
/// so little gravity that discs at rest overlap by 1e-5 mean radii, by which the box is opened. The lid is
/// put above the highest disc at the aspect ratio asked for; the width is found by falling again until the
/// space under the lid is less than a mean diameter, the best of a few tries. Not for a periodic cell. Throws
/// InputError if the box is too narrow for the largest disc, or if the discs do not come to rest.
Packing deposition(const std::vector<double>& radii, const PackingRequest& request, Random& random);

}  // namespace softgrain
