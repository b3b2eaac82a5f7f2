#pragma once
// Grain radii drawn from a size law.
#include <vector>

#include "common/packing/random.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// spec.count radii [m]. gaussian: truncated to [radius_min, radius_max]; fractal: number of grains larger
/// than r ~ r^-D between the cut-offs; uniform_volume: the area (the volume in 2D) uniform between those of
/// the cut-offs; single: radius_mean; uniform: the radius uniform between the cut-offs; two_sizes: the
/// nearest whole number to small_share spec.count of radius_min, the rest of radius_max, in random order.
std::vector<double> draw_radii(const PackingSpec& spec, Random& random);

}  // namespace softgrain
