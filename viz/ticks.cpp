#include "viz/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace softgrain {

double round_down(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double step : {5.0, 2.0})
        if (step * power <= value) return step * power;
    return power;
}

std::vector<double> round_ticks(double min, double max) {
    const double spacing = round_down((max - min) / 3.5);
    std::vector<double> ticks;
    for (double k = std::ceil(min / spacing - 1e-9); k * spacing <= max + 1e-9 * spacing; k += 1.0)
        ticks.push_back(std::clamp(k * spacing, min, max));  // VTK drops what is outside by rounding
    return ticks;
}

std::string tick_text(double value, double spacing) {
    if (value == 0.0 || std::abs(value) < 1e-9 * spacing) return "0";
    const double size = std::max(std::abs(value), spacing);
    if (size >= 1e4 || spacing < 1e-3) return fmt::format("{:.3g}", value);
    const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(spacing) - 1e-9)));
    return fmt::format("{:.{}f}", value, digits);
}

}  // namespace softgrain
