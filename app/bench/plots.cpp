#include "app/bench/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/bench/choice.hpp"
#include "app/methods.hpp"

namespace softgrain::bench {
namespace {

constexpr std::array markers{MarkerStyle::circle, MarkerStyle::square, MarkerStyle::diamond,
                             MarkerStyle::plus};
constexpr double least_drawn = 1e-4;  ///< that is drawn as it is
constexpr double most_drawn = 3.0;

struct Bounds {
    double low, high;

    void include(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void widen() {
        low /= 1.5;
        high *= 1.5;
    }
};

double drawn(double error) {
    return std::clamp(error, least_drawn, most_drawn);
}

/// Rows of one knob with this error, in the order of the plan.
std::vector<const Row*> sweep(const CaseRows& one, std::size_t quantity, const Setting& knob, bool eligible) {
    std::vector<const Row*> rows;
    for (const Row& row : one.rows)
        if (row.setting->knob == knob.knob && row.setting->method == knob.method && row.error[quantity] &&
            is_eligible(row) == eligible && row.cost.cpu > 0.0)
            rows.push_back(&row);
    return rows;
}

PlotSeries series_of(const std::vector<const Row*>& rows, std::size_t quantity) {
    PlotSeries series;
    for (const Row* row : rows) {
        series.x.push_back(row->cost.cpu);
        series.y.push_back(drawn(*row->error[quantity]));
    }
    return series;
}

/// The knobs in the order of the plan, each by its first setting.
std::vector<const Setting*> knobs_of(const CaseRows& one) {
    std::vector<const Setting*> knobs;
    for (const Row& row : one.rows)
        if (std::ranges::none_of(knobs, [&](const Setting* other) {
                return other->knob == row.setting->knob && other->method == row.setting->method;
            }))
            knobs.push_back(row.setting);
    return knobs;
}

}  // namespace

int colour_of(const std::string& method) {
    const auto all = methods();
    return static_cast<int>(std::ranges::find(all, method, &Method::name) - all.begin());
}

std::optional<PlotSpec> error_plot(const CaseRows& one, std::size_t quantity) {
    PlotSpec plot;
    plot.title = one.of->title;
    plot.x = {"CPU time [s]", true, {}, {}};
    plot.y = {fmt::format("relative error of {}", quantity_names[quantity].title), true, {}, {}};
    plot.legend = "right";
    plot.width = 2200;
    std::optional<Bounds> x, y;
    const auto add = [&](PlotSeries series) {
        for (std::size_t k = 0; k < series.x.size(); ++k) {
            if (!x) x = {series.x[k], series.x[k]}, y = {series.y[k], series.y[k]};
            x->include(series.x[k]);
            y->include(series.y[k]);
        }
        plot.series.push_back(std::move(series));
    };
    std::array<std::size_t, 16> drawn_of{};  // knobs of each method so far
    bool has_short = false;
    for (const Setting* knob : knobs_of(one)) {
        const int colour = colour_of(knob->method);
        if (const auto rows = sweep(one, quantity, *knob, true); !rows.empty()) {
            PlotSeries series = series_of(rows, quantity);
            series.label = fmt::format("{}, {}", knob->method, knob->knob);
            series.colour = colour;
            series.width = 0.6;
            const std::size_t number = drawn_of[static_cast<std::size_t>(colour)]++;
            series.marker = markers[number % markers.size()];
            series.line = number < markers.size() ? LineStyle::solid : LineStyle::dashed;
            add(std::move(series));
        }
        if (const auto rows = sweep(one, quantity, *knob, false); !rows.empty()) {
            PlotSeries series = series_of(rows, quantity);
            series.colour = colour;
            series.line = LineStyle::none;
            series.marker = MarkerStyle::cross;
            if (!has_short) series.label = "x: covers too little, or failed";
            has_short = true;
            add(std::move(series));
        }
    }
    if (!x) return std::nullopt;

    std::vector<const Row*> front;
    for (const std::size_t k : pareto_front(one))
        if (one.rows[k].error[quantity]) front.push_back(&one.rows[k]);
    if (front.size() > 1 && quantity == stress) {
        PlotSeries line = series_of(front, quantity);
        line.label = "Pareto front";
        line.colour = black;
        line.line = LineStyle::dashed;
        plot.series.push_back(std::move(line));
    }
    if (one.own_error[quantity]) y->include(drawn(*one.own_error[quantity]));
    x->widen();
    y->widen();
    if (one.own_error[quantity]) {
        PlotSeries band;
        band.label = "reference's own error";
        band.x = {x->low, x->high};
        band.y = band.upper = {drawn(*one.own_error[quantity]), drawn(*one.own_error[quantity])};
        band.lower = {y->low, y->low};
        band.colour = black;
        band.line = LineStyle::dotted;
        plot.series.push_back(std::move(band));
    }
    plot.x.min = x->low, plot.x.max = x->high;
    plot.y.min = y->low, plot.y.max = y->high;
    return plot;
}

}  // namespace softgrain::bench
