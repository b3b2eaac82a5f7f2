#include "app/report/curves.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::report {
namespace {

constexpr double rounding = 1e-4;       ///< of the largest stress
constexpr double worth_showing = 0.05;  ///< deviatoric stress / largest mean stress
constexpr int black = 4;                ///< in the palette

PlotSeries series_of(const std::string& name, const History& history, std::string_view column,
                     bool logarithmic) {
    PlotSeries series;
    series.label = name;
    series.x = history.column("packing_fraction");
    series.y = history.column(column);
    const auto error = history.columns.find(std::string(column) + "_error");
    if (error != history.columns.end())
        for (std::size_t k = 0; k < series.y.size(); ++k) {
            series.lower.push_back(series.y[k] - error->second[k]);
            series.upper.push_back(series.y[k] + error->second[k]);
        }
    if (logarithmic && !series.y.empty()) {
        const double largest = *std::max_element(series.y.begin(), series.y.end());
        for (double& y : series.y) y = y > rounding * largest ? y : std::nan("");
    }
    return series;
}

}  // namespace

PlotSpec curve_plot(const std::string& title, const std::vector<MethodResult>& results,
                    const std::optional<Reference>& reference, std::string_view column,
                    const std::string& label, bool logarithmic) {
    PlotSpec plot;
    plot.title = title;
    plot.x.label = "packing fraction";
    plot.y.label = label;
    plot.y.logarithmic = logarithmic;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (!results[k].history) continue;
        plot.series.push_back(series_of(results[k].report.method, *results[k].history, column, logarithmic));
        plot.series.back().colour = static_cast<int>(k);
    }
    if (reference && reference->history.columns.contains(column)) {
        plot.series.push_back(series_of(reference->name, reference->history, column, logarithmic));
        plot.series.back().line = LineStyle::dashed;
        plot.series.back().colour = black;
    }
    return plot;
}

bool has_deviatoric_stress(const std::vector<MethodResult>& results) {
    return std::ranges::any_of(results, [](const MethodResult& result) {
        if (!result.history) return false;
        const auto largest = [&](std::string_view column) {
            double most = 0.0;
            for (const double v : result.history->column(column))
                if (std::isfinite(v)) most = std::max(most, std::abs(v));
            return most;
        };
        return largest("deviatoric_stress") > worth_showing * largest("mean_stress");
    });
}

}  // namespace softgrain::report
