#pragma once
// What a method could not do in this comparison.
#include <string>
#include <vector>

#include "app/comparison_table.hpp"
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain::report {

/// Features that the scenario asks for and the method does not have, how the run ended if not in order,
/// columns of the history without a number, steps that did not converge. Plain text; empty if nothing was
/// missing.
std::vector<std::string> limits(const MethodResult& result, const Scenario& scenario, const Packing& packing);

/// The same for all methods, as HTML.
std::string limits_section(const std::vector<MethodResult>& results, const Scenario& scenario,
                           const Packing& packing);

}  // namespace softgrain::report
