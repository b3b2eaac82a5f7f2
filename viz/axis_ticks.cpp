#include "viz/axis_ticks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "viz/ticks.hpp"

namespace softgrain {
namespace {

constexpr int most_decades = 8;  ///< with numbers
/// Ends of a logarithmic axis of few decades whose numbers are easier to read without powers.
constexpr double least_plain = 5e-3, most_plain = 1e4;

/// "2e-05" as 2 times a power, with a true minus.
AxisTick named_tick(double place, const std::string& text) {
    const std::size_t e = text.find('e');
    std::string mantissa = text.substr(0, e);
    if (mantissa.starts_with("-")) mantissa = "\u2212" + mantissa.substr(1);
    if (e == std::string::npos) return {place, mantissa};
    return {place, mantissa + "\u00b7", std::atoi(text.c_str() + e + 1)};
}

std::vector<AxisTick> linear_ticks(const PlotRange& range) {
    const auto values = round_ticks(range.min, range.max);
    const double spacing = values.size() > 1 ? values[1] - values[0] : std::abs(values[0]);
    std::vector<AxisTick> ticks;
    for (const double v : values)
        ticks.push_back(named_tick(place_on_axis(v, range, false), tick_text(v, spacing)));
    return ticks;
}

std::vector<AxisTick> logarithmic_ticks(const PlotRange& range) {
    const int first = static_cast<int>(std::floor(std::log10(range.min)));
    const int last = static_cast<int>(std::ceil(std::log10(range.max)));
    const int every = 1 + (last - first) / (most_decades + 1);
    const bool few = range.max < 100.0 * range.min, within_one = range.max < 6.0 * range.min;
    std::vector<AxisTick> ticks;
    for (int decade = first; decade <= last; ++decade)
        for (int step = 1; step <= (every > 1 ? 1 : 9); ++step) {
            const double value = step * std::pow(10.0, decade);
            if (value < range.min * (1.0 - 1e-9) || value > range.max * (1.0 + 1e-9)) continue;
            const double place = place_on_axis(value, range, true);
            const bool named =
                step == 1 ? decade % every == 0 : few && (step == 2 || step == 5 || within_one);
            if (!named)
                ticks.push_back({place});
            else if (few && range.min >= least_plain && range.max <= most_plain)
                ticks.push_back({place, fmt::format("{:g}", value)});
            else
                ticks.push_back({place, step == 1 ? "" : fmt::format("{}\u00b7", step), decade});
        }
    return ticks;
}

}  // namespace

std::vector<AxisTick> axis_ticks(const PlotAxis& axis, const PlotRange& range) {
    return axis.logarithmic ? logarithmic_ticks(range) : linear_ticks(range);
}

}  // namespace softgrain
