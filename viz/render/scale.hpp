#pragma once
// Colours and their range.
#include <vector>

#include "viz/render/page.hpp"
#include "viz/ticks.hpp"

namespace softgrain {

/// Viridis, readable with any colour vision and in grey; t is clamped to [0, 1], nan is grey.
Colour viridis(double t);

/// The range of a colour scale and whether values lie outside it.
struct ColourRange {
    double min, max;
    bool below, above;

    double fraction(double value) const { return (value - min) / (max - min); }
    bool has_both_signs() const { return min < 0.0 && max > 0.0; }
};

/// Purple, white, orange (PuOr of Harrower and Brewer 2003), readable with any colour vision; t from -1 to 1
/// is clamped, nan is grey.
Colour purple_orange(double t);

/// Viridis; where a range has both signs purple for values below 0, orange above, as dark for equal sizes.
Colour colour_of(const ColourRange& range, double value);

/// From the 2nd to the 98th percentile, widened to 0 on the near side. `values` may hold nan.
ColourRange robust_range(std::vector<double> values);
/// The same with given ends.
ColourRange given_range(const std::vector<double>& values, double min, double max);

/// Value below which this share of the values lies; 0 for no values.
double percentile(std::vector<double>& values, double share);

}  // namespace softgrain
