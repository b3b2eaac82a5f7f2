#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "app/bench/plots.hpp"
#include "app/bench/scaling/scaling_tables.hpp"

namespace softgrain::bench {
namespace {

constexpr std::array markers{MarkerStyle::circle, MarkerStyle::square, MarkerStyle::diamond,
                             MarkerStyle::plus};

PlotSpec empty_plot(const char* title, const char* x, const char* y, bool y_logarithmic) {
    PlotSpec plot;
    plot.title = title;
    plot.x = {x, true, {}, {}};
    plot.y = {y, y_logarithmic, {}, {}};
    plot.legend = "right";
    plot.width = 2200;
    return plot;
}

/// A line over the number of grains for each subject and number of threads of which `value` is known.
PlotSpec over_grains(PlotSpec plot, const ScalingPlan& plan, const ScalingResults& results,
                     const std::function<std::optional<double>(const ScalingPoint&)>& value) {
    for (const Subject& subject : plan.subjects)
        for (std::size_t t = 0; t < subject.threads.size(); ++t) {
            PlotSeries series;
            for (const int count : subject.counts)
                if (const ScalingPoint* one = results.find(subject, count, subject.threads[t]))
                    if (const auto y = value(*one)) {
                        series.x.push_back(count);
                        series.y.push_back(*y);
                    }
            if (series.x.empty()) continue;
            series.label = fmt::format("{}, {} thread{}", subject.name, subject.threads[t],
                                       subject.threads[t] == 1 ? "" : "s");
            series.colour = colour_of(subject.method);
            series.marker = markers[t % markers.size()];
            series.line = t == 0 ? LineStyle::solid : LineStyle::dashed;
            plot.series.push_back(std::move(series));
        }
    return plot;
}

PlotSeries roof(const char* label, std::vector<double> x, std::vector<double> y, LineStyle line) {
    PlotSeries series;
    series.label = label;
    series.x = std::move(x);
    series.y = std::move(y);
    series.colour = black;
    series.line = line;
    return series;
}

PlotSpec roofline_plot(const std::vector<RooflinePoint>& points, const MachineLimits& limits) {
    constexpr double giga = 1e-9;
    PlotSpec plot = empty_plot("Roofline, one core", "flops per byte", "Gflop/s", true);
    double low = limits.flops / limits.memory, high = 2.0 * low, least = giga * limits.flops;
    for (const RooflinePoint& one : points) {
        low = std::min(low, one.near_intensity());
        high = std::max(high, one.near_intensity());
        if (one.count->far_bytes > 0.0) high = std::max(high, one.far_intensity());
        least = std::min(least, giga * one.rate);
    }
    low = std::min(low, limits.flops / limits.cache) / 2.0, high *= 2.0, least /= 2.0;
    const auto slope = [&](double bandwidth) {
        const double begin = std::max(low, least / (giga * bandwidth)), ridge = limits.flops / bandwidth;
        return std::pair{std::vector{begin, ridge, high},
                         std::vector{giga * bandwidth * begin, giga * limits.flops, giga * limits.flops}};
    };
    auto [x, y] = slope(limits.cache);
    plot.series.push_back(roof("first cache", x, y, LineStyle::solid));
    std::tie(x, y) = slope(limits.memory);
    plot.series.push_back(roof("memory", x, y, LineStyle::dashed));
    std::size_t number = 0;
    const Subject* last = nullptr;
    for (const RooflinePoint& one : points) {
        number = one.of == last ? number + 1 : 0;
        last = one.of;
        PlotSeries series;
        series.label = fmt::format("{}, {}", one.of->name, one.count->title);
        // The same rate against both counts of bytes: the left end belongs to the cache, the right one to
        // memory.
        series.x = {one.near_intensity()};
        if (one.count->far_bytes > 0.0) series.x.push_back(one.far_intensity());
        series.y.assign(series.x.size(), giga * one.rate);
        series.colour = colour_of(one.of->method);
        series.marker = markers[number % markers.size()];
        series.line = number < markers.size() ? LineStyle::dotted : LineStyle::dashed;
        plot.series.push_back(std::move(series));
    }
    plot.x.min = low, plot.x.max = high;
    plot.y.min = least, plot.y.max = 2.0 * giga * limits.flops;
    return plot;
}

}  // namespace

std::vector<NamedPlot> scaling_plots(const ScalingPlan& plan, const ScalingResults& results,
                                     const MachineLimits& limits) {
    std::vector<NamedPlot> plots;
    const auto add = [&](const char* name, PlotSpec plot) {
        if (!plot.series.empty()) plots.push_back({name, std::move(plot)});
    };
    add("cost",
        over_grains(empty_plot("Cost of a step", "grains", "CPU time of a grain and step [ns]", true), plan,
                    results, [](const ScalingPoint& one) { return std::optional(1e9 * one.cpu()); }));
    add("threads",
        over_grains(empty_plot("Gain by threads", "grains", "wall time of 1 thread / wall time", false), plan,
                    results, [&](const ScalingPoint& one) -> std::optional<double> {
                        const ScalingPoint* alone = results.find(*one.of, one.count, 1);
                        if (!alone || one.threads == 1) return std::nullopt;
                        return alone->wall() / one.wall();
                    }));
    add("memory", over_grains(empty_plot("Memory", "grains", "bytes of a grain", true), plan, results,
                              [](const ScalingPoint& one) { return std::optional(one.memory()); }));
    const auto points = roofline(plan, results, limits);
    if (!points.empty()) add("roofline", roofline_plot(points, limits));
    return plots;
}

}  // namespace softgrain::bench
