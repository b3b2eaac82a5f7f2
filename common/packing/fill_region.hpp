#pragma once
// Discs at random places in a part of a box.
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/random.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// Discs of these radii at random places, the largest first, that overlap neither each other nor the region's
/// edge. Throws InputError if there is no room.
Packing fill_region(const std::vector<double>& radii, const PackingRegion& region, const Box& box,
                    Random& random);

}  // namespace softgrain
