#include "app/report/force_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <optional>

#include "app/report/curve_error.hpp"
#include "app/report/figure.hpp"
#include "app/report/words.hpp"
#include "common/errors.hpp"

namespace softgrain::report {
namespace {

namespace fs = std::filesystem;

constexpr double contacts_per_bin =
    30.0;                           ///< with bins of a tenth of the mean that many near the mean, or wider
constexpr double fine_bins = 10.0;  ///< in one mean force

/// Packing fraction at the time that stands in the file's first line; nan if none does.
double packing_fraction_of(const fs::path& path, const History& history) {
    std::string line;
    std::ifstream file(path);
    constexpr std::string_view before = "# time ";
    if (!std::getline(file, line) || !line.starts_with(before)) return std::nan("");
    const double time = std::strtod(line.c_str() + before.size(), nullptr);
    const auto& times = history.column("time");
    const auto row = std::ranges::min_element(times, {}, [&](double t) { return std::abs(t - time); });
    return history.column("packing_fraction")[static_cast<std::size_t>(row - times.begin())];
}

/// Joins neighbouring bins, so that few contacts do not leave most of them empty.
void widen(ForceFrame& frame, std::size_t bins) {
    ForceFrame wide{frame.packing_fraction, {}, {}};
    for (std::size_t k = 0; k < frame.density.size(); k += bins) {
        double density = 0.0;
        for (std::size_t b = k; b < std::min(k + bins, frame.density.size()); ++b)
            density += frame.density[b] / static_cast<double>(bins);
        wide.force.push_back((static_cast<double>(k) + 0.5 * static_cast<double>(bins)) / fine_bins);
        wide.density.push_back(density > 0.0 ? density : std::nan(""));
    }
    frame = std::move(wide);
}

PlotSpec force_plot(const std::string& title, const std::vector<MethodResult>& results,
                    const fs::path& folder, const std::vector<double>& at) {
    PlotSpec plot;
    plot.title = title;
    plot.x.label = "normal force / its mean";
    plot.y.label = "probability density";
    plot.y.logarithmic = true;
    for (std::size_t k = 0; k < results.size(); ++k) {
        const auto frame = force_frame(results[k], folder, at[k]);
        if (!frame) continue;
        PlotSeries series;
        series.label = fmt::format("{}, \u03c6 = {}", results[k].report.method,
                                   packing_fraction(frame->packing_fraction));
        series.x = frame->force;
        series.y = frame->density;
        series.marker = MarkerStyle::circle;
        series.colour = static_cast<int>(k);
        plot.series.push_back(std::move(series));
    }
    return plot;
}

}  // namespace

std::optional<ForceFrame> force_frame(const MethodResult& result, const fs::path& folder,
                                      double packing_fraction) {
    const fs::path measures = folder / result.report.method / "measures";
    if (!result.history || result.history->rows() == 0 || !fs::exists(measures)) return std::nullopt;
    std::optional<ForceFrame> nearest;
    const auto distance = [&](double phi) { return std::abs(phi - packing_fraction); };
    for (const auto& entry : fs::directory_iterator(measures)) {
        if (!entry.path().filename().string().starts_with("forces_")) continue;
        const double phi = packing_fraction_of(entry.path(), *result.history);
        if (!std::isfinite(phi) || (nearest && distance(phi) >= distance(nearest->packing_fraction)))
            continue;
        const History file = read_history(entry.path());
        if (file.rows() == 0) continue;
        nearest = {phi, file.column("force_over_mean"), file.column("probability_density")};
    }
    if (!nearest) return std::nullopt;
    const double z =
        at_packing_fraction(*result.history, "coordination_number", nearest->packing_fraction).value_or(4.0);
    const double contacts = std::max(1.0, 0.5 * z * static_cast<double>(result.report.grains));
    widen(*nearest,
          static_cast<std::size_t>(std::clamp(std::ceil(fine_bins * contacts_per_bin / contacts), 2.0, 5.0)));
    return nearest;
}

std::string force_section(const std::vector<MethodResult>& results, const fs::path& folder) {
    double common = 2.0, farthest = 0.0;
    std::vector<double> ends;
    for (const MethodResult& result : results) {
        ends.push_back(result.history ? covered(*result.history).high : 0.0);
        if (!result.history) continue;
        common = std::min(common, ends.back());
        farthest = std::max(farthest, ends.back());
    }
    const std::vector<double> equal(results.size(), common);
    std::vector<PlotSpec> plots{force_plot("Last common packing fraction", results, folder, equal)};
    if (plots[0].series.empty())
        return "<p>No forces were written with these runs; run again with <code>--force</code> to have "
               "them.</p>\n";
    if (farthest - common > same_packing)
        plots.push_back(force_plot("End of each run", results, folder, ends));
    return figures(plots) +
           "<p class=\"note\">Normal forces of contacts between grains that press, divided by their mean, at "
           "the frame "
           "nearest to the packing fraction. Bins are 0.2 to 0.5 wide, wider with fewer contacts; bins "
           "without a force "
           "leave a gap.</p>\n";
}

}  // namespace softgrain::report
