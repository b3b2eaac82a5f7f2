#pragma once
// Round numbers for axes and scales.
#include <string>
#include <vector>

namespace softgrain {

/// 4 to 8 round numbers within [min, max].
std::vector<double> round_ticks(double min, double max);
/// Largest 1, 2 or 5 times a power of ten that is not above `value` > 0.
double round_down(double value);
/// Short text of a tick value among its neighbours.
std::string tick_text(double value, double spacing);

}  // namespace softgrain
