#pragma once
// The aggregates of a whole packing.
#include <vector>

#include "bpm/aggregate.hpp"
#include "bpm/solver.hpp"
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain::bpm {

/// Aggregate for each grain of the packing, about its own centre; from the cache if they are there. Throws
/// InputError if a disc would be larger than its grain or there were too many, DivergedError if a preparation
/// fails, and StopAsked, with nothing kept in the cache.
std::vector<Aggregate> prepare_grains(const Scenario& scenario, const Packing& packing,
                                      const BpmSettings& settings);

/// Discs of a grain: by its area, so that discs are of one size in all grains. Throws InputError.
int discs_in_grain(const BpmSettings& settings, double radius, double mean_radius);

}  // namespace softgrain::bpm
