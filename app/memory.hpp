#pragma once
// How much memory a run is going to need, told before anything large is made.
#include <cstdint>

#include "common/scenario.hpp"
#include "common/solver.hpp"

namespace softgrain {

/// Peak memory of a run by numbers that were measured (docs/reliability.md) [bytes]. Within a factor of two.
double estimated_memory(const Scenario& scenario, const Method& method);

/// What this process may use: of the machine, or of its control group [bytes].
std::uint64_t available_memory();

/// Throws InputError if the estimate is above `limit` [bytes]; 0: what is available.
void check_memory(const Scenario& scenario, const Method& method, std::uint64_t limit);

}  // namespace softgrain
