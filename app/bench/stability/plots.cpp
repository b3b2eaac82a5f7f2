#include "app/bench/stability/plots.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/rows.hpp"

namespace softgrain::bench {
namespace {

constexpr int grey = 4;  ///< black in the palette

PlotSeries level(double value, const char* label, const std::vector<double>& phi) {
    PlotSeries line;
    line.label = label;
    line.x = {phi.front(), phi.back()};
    line.y = {value, value};
    line.colour = grey;
    line.line = LineStyle::dashed;
    return line;
}

}  // namespace

std::optional<PlotSpec> map_plot(const std::vector<MapRow>& rows, const MapPlan& plan) {
    PlotSpec plot;
    plot.title = fmt::format("Largest stable step, {}", plan.name);
    plot.x = {"undeformed packing fraction", false, {}, {}};
    plot.y = {"largest stable step / default step", true, {}, {}};
    plot.legend = "right";
    plot.width = 2200;
    for (std::size_t d = 0; d < plan.damping.size(); ++d) {
        PlotSeries series;
        series.label = plan.damping[d].empty() ? "default damping" : plan.damping[d];
        series.colour = static_cast<int>(d) >= grey ? static_cast<int>(d) + 1 : static_cast<int>(d);
        series.marker = MarkerStyle::circle;
        for (const double phi : plan.phi) {
            std::vector<double> waste;
            for (const MapRow& row : rows)
                if (row.plan == &plan && row.not_measured.empty() && row.cell.phi == phi &&
                    row.cell.damping == plan.damping[d])
                    waste.push_back(row.waste());
            if (waste.empty()) continue;
            series.x.push_back(phi);
            series.y.push_back(median(waste));
            series.lower.push_back(std::ranges::min(waste));
            series.upper.push_back(std::ranges::max(waste));
        }
        if (!series.x.empty()) plot.series.push_back(std::move(series));
    }
    if (plot.series.empty()) return std::nullopt;
    plot.series.push_back(level(1.0, "the default is stable above", plan.phi));
    plot.series.push_back(level(2.0, "the default wastes a factor 2", plan.phi));
    plot.series.back().line = LineStyle::dotted;
    return plot;
}

}  // namespace softgrain::bench
