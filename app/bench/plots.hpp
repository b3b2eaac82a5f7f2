#pragma once
// Work-precision diagrams.
#include <optional>
#include <string>

#include "app/bench/rows.hpp"
#include "viz/plot_spec.hpp"

namespace softgrain::bench {

inline constexpr int black = 4;  ///< in the palette

/// A method's colour is the same in all plots: its place in the table of methods.
int colour_of(const std::string& method);

/// Error of a quantity over CPU time, logarithmic both: a line for each knob in the colour of its method, the
/// Pareto front of stress in black, the reference's own error as a band, what is not eligible as crosses;
/// errors above 3 at 3. None if no row has such an error.
std::optional<PlotSpec> error_plot(const CaseRows& one, std::size_t quantity);

}  // namespace softgrain::bench
