#pragma once
// The packing that a scenario asks for.
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// Reads packing.path, or draws radii and places them by packing.generator; the same packing for the same
/// scenario and seed. Ellipses lie at random angles inside the discs that are placed. A generated packing is
/// scaled as a whole to box.width and box.height if they are given, else its radii are those of the size law.
/// Throws InputError.
Packing make_packing(const Scenario& scenario);

}  // namespace softgrain
