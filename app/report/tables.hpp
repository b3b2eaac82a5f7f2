#pragma once
// The tables of the report: error and cost, energy. With their notes, as HTML.
#include <optional>
#include <string>
#include <vector>

#include "app/report/curve_error.hpp"
#include "app/report/html.hpp"

namespace softgrain::report {

/// The name of a method with the colour of its curves; `number` is its place among the results.
Cell method_cell(const std::vector<MethodResult>& results, std::size_t number);

std::string methods_table(const std::vector<MethodResult>& results, const std::optional<Truth>& truth);
std::string energy_table(const std::vector<MethodResult>& results);

}  // namespace softgrain::report
