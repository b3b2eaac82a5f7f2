#pragma once
// The plots of a comparison.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/comparison_table.hpp"
#include "viz/plot_spec.hpp"

namespace softgrain::report {

/// A column of all histories over packing fraction, or over shear or axial strain if the loading changes the
/// packing fraction by less than 0.02; the reference dashed and black, with a band where it has
/// a column NAME_error. On a logarithmic axis what is below 1e-4 of a curve's largest value is left out:
/// rounding before the first contact is no stress.
PlotSpec curve_plot(const std::string& title, const std::vector<MethodResult>& results,
                    const std::optional<Reference>& reference, std::string_view column,
                    const std::string& label, bool logarithmic);

/// True if some deviatoric stress is more than a twentieth of the largest mean stress of its run.
bool has_deviatoric_stress(const std::vector<MethodResult>& results);

}  // namespace softgrain::report
