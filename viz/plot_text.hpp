#pragma once
// A line plot in letters, for terminals.
#include <string>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// The series with inline numbers on linear axes, in the range of their data: "*" for the first, "o", "+",
/// "x" for more. Samples are joined; nan leaves a gap. Empty if nothing is finite. width, height: of the
/// field [letters].
std::string plot_text(const PlotSpec& spec, int width = 64, int height = 12);

}  // namespace softgrain
