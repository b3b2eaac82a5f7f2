#include "viz/plot_data.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/errors.hpp"
#include "viz/csv_table.hpp"

namespace softgrain {
namespace {

constexpr double room = 0.04;   ///< left free at each end of an axis, times its length
constexpr double noise = 1e-6;  ///< on a logarithmic axis without min, times the largest value

/// Replaces what a logarithmic axis cannot show, and rounding noise that would fill most of it, by nan.
void drop_below(double floor, std::vector<double>& values) {
    for (double& v : values)
        if (!(v > 0.0 && v >= floor)) v = std::numeric_limits<double>::quiet_NaN();
}

/// Smallest and largest of the finite numbers so far.
struct Bounds {
    double min = std::numeric_limits<double>::infinity();
    double max = -std::numeric_limits<double>::infinity();

    void include(const std::vector<double>& values) {
        for (const double v : values) {
            if (!std::isfinite(v)) continue;
            min = std::min(min, v);
            max = std::max(max, v);
        }
    }
};

Bounds x_bounds(const PlotSpec& spec) {
    Bounds bounds;
    for (const PlotSeries& series : spec.series) bounds.include(series.x);
    return bounds;
}

Bounds y_bounds(const PlotSpec& spec) {
    Bounds bounds;
    for (const PlotSeries& series : spec.series)
        for (const auto* values : {&series.y, &series.lower, &series.upper}) bounds.include(*values);
    return bounds;
}

PlotRange widen(const Bounds& bounds, const PlotAxis& axis) {
    PlotRange range{bounds.min, bounds.max};
    if (axis.logarithmic) {
        const double factor = std::max(std::pow(range.max / range.min, room), 1.1);
        range = {range.min / factor, range.max * factor};
    } else {
        double length = range.max - range.min;
        if (length == 0.0) length = range.max == 0.0 ? 1.0 : std::abs(range.max);
        const bool near_zero = range.min >= 0.0 && range.min < 0.3 * range.max;
        range = {near_zero ? 0.0 : range.min - room * length, range.max + room * length};
    }
    return {axis.min.value_or(range.min), axis.max.value_or(range.max)};
}

}  // namespace

void load_plot_data(PlotSpec& spec, const std::filesystem::path& folder) {
    for (PlotSeries& series : spec.series) {
        if (series.csv.empty()) continue;
        const CsvTable table(folder / series.csv);
        series.x = table.column(series.x_column);
        series.y = table.column(series.y_column);
        if (!series.lower_column.empty()) series.lower = table.column(series.lower_column);
        if (!series.upper_column.empty()) series.upper = table.column(series.upper_column);
    }
    const double x_floor = spec.x.min ? 0.0 : noise * x_bounds(spec).max;
    const double y_floor = spec.y.min ? 0.0 : noise * y_bounds(spec).max;
    bool any = false;
    for (PlotSeries& series : spec.series) {
        if (spec.x.logarithmic) drop_below(x_floor, series.x);
        if (spec.y.logarithmic)
            for (auto* values : {&series.y, &series.lower, &series.upper}) drop_below(y_floor, *values);
        for (std::size_t k = 0; k < series.x.size(); ++k)
            any = any || (std::isfinite(series.x[k]) && std::isfinite(series.y[k]));
    }
    if (!any) throw InputError("the plot has no point that can be drawn");
}

double place_on_axis(double value, const PlotRange& range, bool logarithmic) {
    if (!logarithmic) return (value - range.min) / (range.max - range.min);
    return std::log(value / range.min) / std::log(range.max / range.min);
}

PlotRange x_range(const PlotSpec& spec) {
    return widen(x_bounds(spec), spec.x);
}

PlotRange y_range(const PlotSpec& spec) {
    return widen(y_bounds(spec), spec.y);
}

std::string emptiest_corner(const PlotSpec& spec, double width, double height) {
    const PlotRange x = x_range(spec);
    const PlotRange y = y_range(spec);
    struct Corner {
        const char* name;
        bool right, top;
        double weight;
    };
    std::array<Corner, 4> corners{{{"top_left", false, true, 0.0},
                                   {"top_right", true, true, 0.0},
                                   {"bottom_right", true, false, 0.0},
                                   {"bottom_left", false, false, 0.0}}};
    for (const PlotSeries& series : spec.series)
        for (std::size_t k = 0; k < series.x.size(); ++k) {
            const double u = place_on_axis(series.x[k], x, spec.x.logarithmic);
            for (const std::vector<double>* values : {&series.y, &series.lower, &series.upper}) {
                if (k >= values->size()) continue;
                const double v = place_on_axis((*values)[k], y, spec.y.logarithmic);
                for (Corner& corner : corners)
                    if ((corner.right ? u > 1.0 - width : u < width) &&
                        (corner.top ? v > 1.0 - height : v < height))
                        corner.weight += 1.0 / static_cast<double>(series.x.size());
            }
        }
    return std::min_element(corners.begin(), corners.end(),
                            [](const Corner& a, const Corner& b) { return a.weight < b.weight; })
        ->name;
}

}  // namespace softgrain
