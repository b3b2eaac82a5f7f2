#pragma once
// What came out, in three sentences with numbers.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/report/curve_error.hpp"

namespace softgrain::report {

/// The nearest method and its error; what it costs beside the others; what did not run to its end.
/// Plain text.
std::array<std::string, 3> verdict(const std::vector<MethodResult>& results,
                                   const std::optional<Truth>& truth);

/// True if the loading was done; a run may also have left its range of validity, diverged or been refused.
bool is_complete(const RunReport& report);

}  // namespace softgrain::report
