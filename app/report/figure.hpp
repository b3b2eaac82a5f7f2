#pragma once
// Plots within the page.
#include <string>
#include <vector>

#include "viz/plot_spec.hpp"

namespace softgrain::report {

/// Inline SVG, side by side where there is room. A plot without a point that can be drawn is left out.
std::string figures(std::vector<PlotSpec> plots);

}  // namespace softgrain::report
