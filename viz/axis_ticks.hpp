#pragma once
// The marks of an axis and the numbers beside them.
#include <optional>
#include <string>
#include <vector>

#include "viz/plot_data.hpp"

namespace softgrain {

/// A mark; one without a number is a minor one.
struct AxisTick {
    double place;  ///< 0 to 1 along the axis
    std::string mantissa =
        {};  ///< "0.85", or what stands before the 10 of a power, with the dot between them
    std::optional<int> power = {};  ///< of ten

    bool is_minor() const { return mantissa.empty() && !power; }
};

/// Round numbers; on a logarithmic axis decades, with minor ticks at the steps between them. Of less than two
/// decades 2 and 5 times the power have numbers too, of much less than one every step, as decimals if they
/// are not too small; of more than eight not every decade has one.
std::vector<AxisTick> axis_ticks(const PlotAxis& axis, const PlotRange& range);

}  // namespace softgrain
