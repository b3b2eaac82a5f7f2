#include "app/report/limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/methods.hpp"
#include "app/report/html.hpp"
#include "app/report/tables.hpp"
#include "app/report/verdict.hpp"
#include "app/report/words.hpp"
#include "common/errors.hpp"
#include "common/observables/observable.hpp"

namespace softgrain::report {
namespace {

/// One line for each feature that is asked for and not there; the run itself stops at the first.
std::vector<std::string> refused(const Method& method, const Scenario& scenario, const Packing& packing) {
    std::vector<std::string> lines;
    for (const Refusal& refusal : method.refusals) {
        try {
            refuse(scenario, packing, method.name, {&refusal, 1});
        } catch (const InputError& error) {
            lines.emplace_back(error.what());
        }
    }
    return lines;
}

std::vector<std::string> columns_without_numbers(const History& history) {
    std::vector<std::string> names;
    for (const Observable& one : observables()) {
        const auto found = history.columns.find(one.name);
        if (found != history.columns.end() &&
            std::ranges::all_of(found->second, [](double v) { return std::isnan(v); }))
            names.emplace_back(one.name);
    }
    return names;
}

}  // namespace

std::vector<std::string> limits(const MethodResult& result, const Scenario& scenario,
                                const Packing& packing) {
    const Method& method = find_method(result.report.method);
    std::vector<std::string> lines = refused(method, scenario, packing);
    if (lines.empty() && !is_complete(result.report))
        lines.push_back(result.history
                            ? fmt::format("Ended at packing fraction {}: {}.",
                                          packing_fraction(result.history->column("packing_fraction").back()),
                                          result.report.ended)
                            : result.report.ended);
    if (!result.history || result.history->rows() == 0) return lines;
    for (const std::string& warning : result.report.warnings)
        lines.push_back(fmt::format("Warning: {}.", warning));
    if (const auto names = columns_without_numbers(*result.history); !names.empty())
        lines.push_back(fmt::format("Columns of the history without a number: {}.", listed(names)));
    const double unconverged = result.history->column("unconverged_steps").back();
    if (unconverged > 0.0)
        lines.push_back(fmt::format("{} of {} steps did not reach the contact solver's tolerance.",
                                    whole(std::llround(unconverged)), whole(result.report.steps)));
    return lines;
}

std::string limits_section(const std::vector<MethodResult>& results, const Scenario& scenario,
                           const Packing& packing) {
    std::vector<std::pair<std::string, Cell>> lines;
    for (const MethodResult& result : results) {
        std::string markup;
        for (const std::string& line : limits(result, scenario, packing)) markup += element("p", line);
        if (markup.empty()) markup = "<p>Nothing: the whole loading, and a number in every column.</p>\n";
        lines.push_back({result.report.method, {markup}});
    }
    return facts(lines);
}

}  // namespace softgrain::report
