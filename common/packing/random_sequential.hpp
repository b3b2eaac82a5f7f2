#pragma once
// Discs at random places without overlap: random sequential addition.
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/packing_request.hpp"
#include "common/packing/random.hpp"

namespace softgrain {

/// Puts the discs, the largest first, each at a uniformly random place where it overlaps none before it.
/// Widom, J. Chem. Phys. 44 (1966) 3888: equal discs leave no room beyond a packing fraction of 0.547; walls
/// and few discs lower that, mixed sizes raise it. `request` has a packing fraction. Throws InputError naming
/// the fraction that was reached, if a disc finds no room in a million trials.
Packing random_sequential(const std::vector<double>& radii, const PackingRequest& request, Random& random);

/// Places of the radii, by size.
std::vector<std::size_t> largest_first(const std::vector<double>& radii);

}  // namespace softgrain
