#pragma once
// A line plot as SVG text, with the look of the PNG.
#include <string>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// One svg element, a file of its own or part of a page: it has no ids and asks for no other file. The
/// numbers of the series must be in the spec (load_plot_data). Coordinates have three decimals of a pixel.
/// `letters`: how much larger text and lines are than in the PNG.
std::string plot_svg(const PlotSpec& spec, double letters = 1.0);

}  // namespace softgrain
