#pragma once
// Packings of many grains: a cell jammed between walls, copied side by side.
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain::bench {

/// Most grains of the cell that is copied.
inline constexpr int largest_cell = 1000;

/// Copies on a side: the fewest that leave at most `largest_cell` grains, a whole number, in the cell. Throws
/// InputError if there is no such number.
int copies_of(int grains);

/// How much closer the centres are than those of grains that just touch, so that the first step has its
/// contacts.
inline constexpr double squeeze = 0.005;

/// As many grains: cells jammed by the scenario's [packing] and seed, copied and squeezed.
Packing tiled_packing(const Scenario& scenario, int grains);

}  // namespace softgrain::bench
