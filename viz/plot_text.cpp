#include "viz/plot_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace softgrain {
namespace {

constexpr std::array<char, 4> marks{'*', 'o', '+', 'x'};

struct Range {
    double low = std::numeric_limits<double>::infinity(), high = -low;

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    /// Of `cells` letters.
    double place(double value, int cells) const {
        return high > low ? (value - low) / (high - low) * (cells - 1) : 0.0;
    }
};

bool is_shown(const PlotSeries& series, std::size_t k) {
    return std::isfinite(series.x[k]) && std::isfinite(series.y[k]);
}

}  // namespace

std::string plot_text(const PlotSpec& spec, int width, int height) {
    Range x, y;
    for (const PlotSeries& series : spec.series)
        for (std::size_t k = 0; k < series.x.size(); ++k) {
            if (!is_shown(series, k)) continue;
            x.add(series.x[k]);
            y.add(series.y[k]);
        }
    if (!(x.low <= x.high)) return "";

    std::vector<std::string> field(static_cast<std::size_t>(height),
                                   std::string(static_cast<std::size_t>(width), ' '));
    for (std::size_t s = 0; s < spec.series.size(); ++s) {
        const PlotSeries& series = spec.series[s];
        const auto put = [&](double column, double row) {
            field[static_cast<std::size_t>(height - 1 - std::lround(row))]
                 [static_cast<std::size_t>(std::lround(column))] = marks[s % marks.size()];
        };
        for (std::size_t k = 0; k < series.x.size(); ++k) {
            if (!is_shown(series, k)) continue;
            const double column = x.place(series.x[k], width), row = y.place(series.y[k], height);
            put(column, row);
            if (k == 0 || !is_shown(series, k - 1)) continue;
            const double from = x.place(series.x[k - 1], width), below = y.place(series.y[k - 1], height);
            const int letters =
                static_cast<int>(std::ceil(std::max(std::abs(column - from), std::abs(row - below))));
            for (int i = 1; i < letters; ++i) {
                const double share = static_cast<double>(i) / letters;
                put(from + share * (column - from), below + share * (row - below));
            }
        }
    }
    const std::string top = fmt::format("{:.3g}", y.high), bottom = fmt::format("{:.3g}", y.low);
    const std::size_t margin = std::max(top.size(), bottom.size());
    std::string text = fmt::format("{}\n", spec.y.label);
    for (std::size_t row = 0; row < field.size(); ++row) {
        field[row].erase(field[row].find_last_not_of(' ') + 1);
        text += fmt::format("{:>{}} |{}\n",
                            row == 0                  ? top
                            : row + 1 == field.size() ? bottom
                                                      : "",
                            margin, field[row]);
    }
    const std::string left = fmt::format("{:.3g}", x.low), right = fmt::format("{:.3g}", x.high);
    text += fmt::format("{:{}} +{}\n", "", margin, std::string(static_cast<std::size_t>(width), '-'));
    const int room = width - static_cast<int>(left.size() + right.size());
    return text +
           fmt::format("{:{}}  {}{:^{}}{}\n", "", margin, left, spec.x.label, std::max(room, 0), right);
}

}  // namespace softgrain
