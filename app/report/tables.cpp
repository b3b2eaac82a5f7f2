#include "app/report/tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/report/energy.hpp"
#include "app/report/verdict.hpp"
#include "app/report/words.hpp"
#include "viz/markup.hpp"
#include "viz/plot_look.hpp"

namespace softgrain::report {
namespace {

/// What CPU times are divided by: the reference if it was run, else the most expensive.
const RunReport* basis_of_cost(const std::vector<MethodResult>& results, const std::optional<Truth>& truth) {
    if (truth && truth->run) return &truth->run->report;
    const RunReport* basis = nullptr;
    for (const MethodResult& result : results)
        if (result.report.steps > 0 && (!basis || result.report.cpu_time > basis->cpu_time))
            basis = &result.report;
    return basis;
}

std::string ratio(double value) {
    return fmt::format("{:.{}f}", value, value < 0.0995 ? 4 : value < 9.95 ? 2 : 0);
}

/// Relative L2 of stress and of Z, and over what.
std::vector<Cell> error_cells(const MethodResult& result, const Truth& truth) {
    if (&result == truth.run) return {text_cell("reference"), text_cell(""), text_cell("")};
    const auto error = result.history ? curve_error(*result.history, *truth.history) : std::nullopt;
    if (!error) return {text_cell(no_number), text_cell(no_number), text_cell(no_number)};
    return {text_cell(percent(error->stress)),
            text_cell(error->coordination ? percent(*error->coordination) : no_number),
            text_cell(packing_fraction(error->over.low) + "\u2013" + packing_fraction(error->over.high))};
}

std::vector<Cell> cost_cells(const RunReport& report, const RunReport* basis) {
    if (report.steps == 0) return std::vector<Cell>(5, text_cell(no_number));
    return {text_cell(seconds(report.cpu_time)), text_cell(seconds(report.wall_time)),
            text_cell(basis && basis->cpu_time > 0.0 ? ratio(report.cpu_time / basis->cpu_time) : no_number),
            text_cell(fmt::format("{:.0f} MB", report.peak_memory / 1e6)), text_cell(whole(report.steps))};
}

}  // namespace

Cell method_cell(const std::vector<MethodResult>& results, std::size_t number) {
    const auto& c = look::palette[number % look::palette.size()];
    return {fmt::format("<span class=\"swatch\" style=\"background:#{:02x}{:02x}{:02x}\"></span>{}", c[0],
                        c[1], c[2], escape_markup(results[number].report.method))};
}

std::string methods_table(const std::vector<MethodResult>& results, const std::optional<Truth>& truth) {
    const RunReport* basis = basis_of_cost(results, truth);
    Table all;
    all.header = {"method"};
    if (truth)
        all.header.insert(all.header.end(), {"error of stress", "error of Z", "over packing fractions"});
    all.header.insert(all.header.end(),
                      {"CPU time", "wall time", basis ? "CPU time / " + basis->method : "CPU time ratio",
                       "memory", "steps", "how it ended"});
    all.text_columns = {all.header.size() - 1};
    for (std::size_t k = 0; k < results.size(); ++k) {
        auto& row = all.rows.emplace_back();
        const auto add = [&](const std::vector<Cell>& cells) {
            row.insert(row.end(), cells.begin(), cells.end());
        };
        row.push_back(method_cell(results, k));
        if (truth) add(error_cells(results[k], *truth));
        add(cost_cells(results[k].report, basis));
        row.push_back({escape_markup(results[k].report.ended), !is_complete(results[k].report)});
    }
    std::string note = "CPU time is that of all threads; memory is the largest resident set. ";
    if (truth)
        note += fmt::format(
            "Errors are against {}: the relative L2 error of a curve y over packing fraction \u03c6 is "
            "\u221a(\u222b(y \u2212 y_ref)\u00b2 d\u03c6 / \u222b y_ref\u00b2 d\u03c6) over the packing "
            "fractions that both "
            "pass, linear between samples, at the first passage; y is the mean stress of the boundaries, or "
            "the "
            "coordination number Z of contacts between grains.",
            truth->name);
    if (truth && truth->run)
        note += fmt::format(
            " {} has an error of its own, which falls with its resolution and is not in these numbers.",
            truth->name);
    return table(all) + "<p class=\"note\">" + escape_markup(note) + "</p>\n";
}

std::string energy_table(const std::vector<MethodResult>& results) {
    Table all;
    all.header = {"method",     "external work",   "elastic", "kinetic",
                  "dissipated", "of that plastic", "residual"};
    for (std::size_t k = 0; k < results.size(); ++k) {
        auto& row = all.rows.emplace_back();
        row.push_back(method_cell(results, k));
        const auto energy = results[k].history ? energy_shares(*results[k].history) : std::nullopt;
        if (!energy) {
            row.resize(all.header.size(), text_cell(no_number));
            continue;
        }
        row.push_back(text_cell(significant(energy->work) + " J"));
        for (const double share : {energy->elastic, energy->kinetic, energy->dissipated, energy->plastic})
            row.push_back(text_cell(percent(share)));
        row.push_back({percent(energy->residual), energy->is_flagged()});
    }
    return table(all) + fmt::format(
                            "<p class=\"note\">At the end of each run, as shares of the external work since "
                            "the start. Dissipated: by "
                            "damping, friction, impacts, plastic flow and adhesion. The residual is what is "
                            "missing; above {} it is "
                            "flagged.</p>\n",
                            whole_percent(most_residual));
}

}  // namespace softgrain::report
