#include "app/report/curves.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::report {
namespace {

constexpr double rounding = 1e-4;          ///< of the largest stress
constexpr double worth_showing = 0.05;     ///< deviatoric stress / largest mean stress
constexpr double least_compaction = 0.02;  ///< change of packing fraction
constexpr int black = 4;                   ///< in the palette

PlotSeries series_of(const std::string& name, const History& history, std::string_view x_column,
                     std::string_view column, bool logarithmic) {
    PlotSeries series;
    series.label = name;
    series.x = history.column(x_column);
    series.y = history.column(column);
    const auto error = history.columns.find(std::string(column) + "_error");
    if (error != history.columns.end())
        for (std::size_t k = 0; k < series.y.size(); ++k) {
            series.lower.push_back(series.y[k] - error->second[k]);
            series.upper.push_back(series.y[k] + error->second[k]);
        }
    if (logarithmic && !series.y.empty()) {
        const double largest = *std::max_element(series.y.begin(), series.y.end());
        for (std::size_t k = 0; k < series.y.size(); ++k) {
            if (series.y[k] > rounding * largest) continue;
            series.y[k] = std::nan("");
            if (!series.lower.empty()) series.lower[k] = series.upper[k] = std::nan("");
        }
    }
    return series;
}

struct XAxis {
    std::string_view column;
    const char* label;
};

double range_of(const std::vector<MethodResult>& results, std::string_view column) {
    double range = 0.0;
    for (const MethodResult& result : results) {
        if (!result.history || !result.history->columns.contains(column)) continue;
        const auto [least, most] = std::ranges::minmax(result.history->column(column));
        range = std::max(range, most - least);
    }
    return range;
}

/// Packing fraction, unless the loading hardly changes it.
XAxis x_axis(const std::vector<MethodResult>& results) {
    const double axial = range_of(results, "axial_strain"), shear = range_of(results, "shear_strain");
    const bool compaction = range_of(results, "packing_fraction") > least_compaction;
    if (compaction || std::max(axial, shear) < least_compaction)
        return {"packing_fraction", "packing fraction"};
    return shear > axial ? XAxis{"shear_strain", "shear strain"} : XAxis{"axial_strain", "axial strain"};
}

}  // namespace

PlotSpec curve_plot(const std::string& title, const std::vector<MethodResult>& results,
                    const std::optional<Reference>& reference, std::string_view column,
                    const std::string& label, bool logarithmic) {
    PlotSpec plot;
    plot.title = title;
    const XAxis x = x_axis(results);
    plot.x.label = x.label;
    plot.y.label = label;
    plot.y.logarithmic = logarithmic;
    for (std::size_t k = 0; k < results.size(); ++k) {
        if (!results[k].history) continue;
        plot.series.push_back(
            series_of(results[k].report.method, *results[k].history, x.column, column, logarithmic));
        plot.series.back().colour = static_cast<int>(k);
    }
    if (reference && reference->history.columns.contains(column) &&
        reference->history.columns.contains(x.column)) {
        plot.series.push_back(series_of(reference->name, reference->history, x.column, column, logarithmic));
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
