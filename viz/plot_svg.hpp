#pragma once
// A line plot as SVG text, with the look of the PNG.
#include <string>

#include "viz/plot_spec.hpp"

namespace softgrain {

/// One <svg> element, a file of its own or part of a page: it has no ids and asks for no other file. The
/// numbers of the series must be in the spec (load_plot_data). Coordinates have three decimals of a pixel.
std::string plot_svg(const PlotSpec& spec);

}  // namespace softgrain
