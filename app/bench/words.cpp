#include "app/bench/words.hpp"

#include <fmt/format.h>

#include <cmath>

namespace softgrain::bench {

std::string quoted(std::string text) {
    for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
    return "\"" + text + "\"";
}

std::string two_digits(double ratio) {
    const double rounding = std::pow(10.0, std::floor(std::log10(ratio)) - 1.0);
    return fmt::format("{:g}", std::round(ratio / rounding) * rounding);
}

}  // namespace softgrain::bench
