#pragma once
// Discs that move as they are told, behind the grains of a packing.
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// Adds those of the scenario. Throws InputError in a periodic cell, or if one overlaps a grain of the
/// packing.
void add_driven_grains(const Scenario& scenario, Packing& packing);

}  // namespace softgrain
