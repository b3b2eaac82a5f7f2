#include "app/report/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace softgrain::report {

std::string percent(double share) {
    if (!std::isfinite(share)) return no_number;
    const double size = std::abs(100.0 * share);
    if (size < 0.005) return "0 %";
    const int decimals = size < 0.0995 ? 2 : size < 9.95 ? 1 : 0;
    return fmt::format("{}{:.{}f} %", share < 0.0 ? "\u2212" : "", size, decimals);
}

std::string whole_percent(double share) {
    return fmt::format("{:.0f} %", 100.0 * share);
}

std::string seconds(double time) {
    return fmt::format("{:.{}f} s", time, time < 9.995 ? 2 : time < 99.95 ? 1 : 0);
}

std::string significant(double value) {
    return std::isfinite(value) ? fmt::format("{:.3g}", value) : no_number;
}

std::string packing_fraction(double value) {
    return fmt::format("{:.3f}", value);
}

std::string whole(long long value) {
    std::string digits = fmt::format("{}", value);
    for (std::size_t at = digits.size(); at > 3; at -= 3) digits.insert(at - 3, "\u202f");
    return digits;
}

std::string times_less(double a, double b) {
    const double ratio = a < b ? b / a : a / b;
    if (ratio < 1.1) return "about the same as";
    return fmt::format("{:.{}f} times {} than", ratio, ratio < 9.95 ? 1 : 0, a < b ? "less" : "more");
}

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (std::size_t k = 0; k < words.size(); ++k)
        text += (k == 0 ? "" : k + 1 == words.size() ? " and " : ", ") + words[k];
    return text;
}

}  // namespace softgrain::report
