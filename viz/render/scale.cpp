#include "viz/render/scale.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

/// Smith & van der Walt (2015), ten equal steps.
constexpr std::array<std::array<int, 3>, 10> viridis_steps{{{0x44, 0x01, 0x54},
                                                            {0x48, 0x28, 0x78},
                                                            {0x3E, 0x4A, 0x89},
                                                            {0x31, 0x68, 0x8E},
                                                            {0x26, 0x82, 0x8E},
                                                            {0x1F, 0x9E, 0x89},
                                                            {0x35, 0xB7, 0x79},
                                                            {0x6D, 0xCD, 0x59},
                                                            {0xB4, 0xDE, 0x2C},
                                                            {0xFD, 0xE7, 0x25}}};
/// ColorBrewer's eleven colours, from the strongest purple to the strongest orange.
constexpr std::array<std::array<int, 3>, 11> purple_orange_steps{{{0x2D, 0x00, 0x4B},
                                                                  {0x54, 0x27, 0x88},
                                                                  {0x80, 0x73, 0xAC},
                                                                  {0xB2, 0xAB, 0xD2},
                                                                  {0xD8, 0xDA, 0xEB},
                                                                  {0xF7, 0xF7, 0xF7},
                                                                  {0xFE, 0xE0, 0xB6},
                                                                  {0xFD, 0xB8, 0x63},
                                                                  {0xE0, 0x82, 0x14},
                                                                  {0xB3, 0x58, 0x06},
                                                                  {0x7F, 0x3B, 0x08}}};
constexpr Colour no_value{190, 190, 190, 255};

/// The colour at t, clamped to [0, 1], of equal steps.
template <std::size_t count>
Colour between(const std::array<std::array<int, 3>, count>& steps, double t) {
    if (std::isnan(t)) return no_value;
    const double step = std::clamp(t, 0.0, 1.0) * static_cast<double>(count - 1);
    const auto k = std::min(static_cast<std::size_t>(step), count - 2);
    const double share = step - static_cast<double>(k);
    Colour colour{0, 0, 0, 255};
    for (std::size_t c = 0; c < 3; ++c)
        colour[c] =
            static_cast<std::uint8_t>(std::lround((1.0 - share) * steps[k][c] + share * steps[k + 1][c]));
    return colour;
}

void drop_nan(std::vector<double>& values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
}

}  // namespace

Colour viridis(double t) {
    return between(viridis_steps, t);
}

Colour purple_orange(double t) {
    return between(purple_orange_steps, 0.5 + 0.5 * t);
}

Colour colour_of(const ColourRange& range, double value) {
    if (!range.has_both_signs()) return viridis(range.fraction(value));
    return purple_orange(value / std::max(-range.min, range.max));
}

double percentile(std::vector<double>& values, double share) {
    drop_nan(values);
    if (values.empty()) return 0.0;
    const auto rank =
        static_cast<std::ptrdiff_t>(std::lround(share * static_cast<double>(values.size() - 1)));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

ColourRange robust_range(std::vector<double> values) {
    const double low = percentile(values, 0.02);
    const double high = percentile(values, 0.98);
    const double spread = std::max(high, 0.0) - std::min(low, 0.0);
    if (spread == 0.0) return given_range(values, 0.0, 1.0);
    // A few per cent of the other sign is noise, not a side of the scale.
    const double min = low < -0.05 * spread ? low : 0.0;
    const double max = high > 0.05 * spread ? high : 0.0;
    return given_range(values, min, max);
}

ColourRange given_range(const std::vector<double>& values, double min, double max) {
    ColourRange range{min, max, false, false};
    const double tolerance = 1e-6 * (max - min);
    for (const double v : values) {
        range.below = range.below || v < min - tolerance;
        range.above = range.above || v > max + tolerance;
    }
    return range;
}

}  // namespace softgrain
