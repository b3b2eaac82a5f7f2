#pragma once
// What the pictures of a plot have in common, PNG or SVG: colours, sizes, line widths.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "viz/plot_spec.hpp"

namespace softgrain::look {

/// Okabe & Ito (2008), distinct for every colour vision; red, green, blue, opacity.
inline constexpr std::array<std::array<std::uint8_t, 4>, 7> palette{{{0, 114, 178, 255},
                                                                     {213, 94, 0, 255},
                                                                     {0, 158, 115, 255},
                                                                     {204, 121, 167, 255},
                                                                     {0, 0, 0, 255},
                                                                     {230, 159, 0, 255},
                                                                     {86, 180, 233, 255}}};
inline constexpr std::uint8_t band_opacity = 50;  ///< of 255
inline constexpr std::uint8_t grid_grey = 225;
inline constexpr std::uint8_t legend_edge_grey = 200;
inline constexpr std::uint8_t legend_opacity = 225;  ///< of 255

// Times the font size.
inline constexpr double line_width = 0.13;
inline constexpr double axis_width = 0.07;
inline constexpr double marker_size = 0.55;
inline constexpr double small_text = 0.9;  ///< ticks and legend
inline constexpr double title_text = 1.15;
inline constexpr double legend_symbol = 2.2;
inline constexpr double legend_padding = 0.4;

/// [pixels]
inline double font_size(const PlotSpec& spec) {
    return std::min(spec.width / 50.0, spec.height / 36.0);
}

/// Colour of the series with this number.
inline const std::array<std::uint8_t, 4>& colour_of(const PlotSeries& series, std::size_t number) {
    return palette[(series.colour ? static_cast<std::size_t>(*series.colour) : number) % palette.size()];
}

}  // namespace softgrain::look
