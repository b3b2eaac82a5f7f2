#pragma once
// The numbers of a plot, ready to draw, and the ranges of its axes.
#include <filesystem>
#include <vector>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// Reads the CSV columns of a spec into its inline numbers. On a logarithmic axis values <= 0 become nan and,
/// if it has no min, those below 1e-6 of the largest.
/// `folder`: where relative paths start. Throws InputError, also if nothing is left to draw.
void load_plot_data(PlotSpec& spec, const std::filesystem::path& folder);

struct PlotRange {
    double min, max;
};
/// As given, else that of the data with a little room. A linear axis starts at 0 if the data come near it.
PlotRange x_range(const PlotSpec& spec);
PlotRange y_range(const PlotSpec& spec);

/// Place of a value within a range: 0 at its minimum, 1 at its maximum.
double place_on_axis(double value, const PlotRange& range, bool logarithmic);

/// Corner with the fewest points of the data in a box of `width` x `height`, fractions of the plot area:
/// top_left, top_right, bottom_left or bottom_right.
std::string emptiest_corner(const PlotSpec& spec, double width, double height);

}  // namespace softgrain
