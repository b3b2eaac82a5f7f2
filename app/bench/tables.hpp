#pragma once
// error.csv and error.md.
#include <string>
#include <vector>

#include "app/bench/rows.hpp"

namespace softgrain::bench {

/// One row for each case and setting.
std::string error_csv(const std::vector<CaseRows>& cases);

/// Ratios first: headlines, recommended settings; then for each case the cheapest setting within an error and
/// all settings.
std::string error_markdown(const Plan& plan, const std::vector<CaseRows>& cases);

}  // namespace softgrain::bench
