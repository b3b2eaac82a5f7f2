#include "app/bench/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/bench/choice.hpp"
#include "app/bench/words.hpp"
#include "app/markdown_table.hpp"
#include "app/methods.hpp"
#include "app/report/words.hpp"
#include "version.hpp"

namespace softgrain::bench {
namespace {

using Table = std::vector<std::vector<std::string>>;
constexpr std::array targets{0.20, 0.10, 0.05, 0.02};  ///< errors of stress
constexpr const char* none = "-";

std::string number(const std::optional<double>& value) {
    return value ? fmt::format("{:.6g}", *value) : "";
}

std::string error_cell(const CaseRows& one, const Row& row, std::size_t quantity) {
    if (!row.error[quantity]) return none;
    if (*row.error[quantity] > 10.0) return "> 1000 %";
    const std::string text = report::percent(*row.error[quantity]);
    return one.is_at_own_error(row, quantity) ? "own (" + text + ")" : text;
}

/// Methods that have rows, in the order of the project's table.
std::vector<std::string> methods_of(const std::vector<CaseRows>& cases) {
    std::vector<std::string> names;
    for (const Method& m : methods())
        if (std::ranges::any_of(cases, [&](const CaseRows& one) {
                return std::ranges::any_of(one.rows,
                                           [&](const Row& row) { return row.setting->method == m.name; });
            }))
            names.emplace_back(m.name);
    return names;
}

std::string headline(const Headline& one, const std::vector<CaseRows>& cases) {
    const auto ratio = ratio_of(one, cases);
    if (!ratio)
        return fmt::format(
            "- {}: no {} within {} of stress, or no \"{}\", was measured; asked is {} times cheaper.\n",
            one.case_name, one.method, report::whole_percent(one.error), one.against, two_digits(one.times));
    return fmt::format(
        "- {}: {} ({}) is **{} times cheaper** than {} ({}), {} and {} of CPU time, at {} error of stress; "
        "asked is {} times at {}: {}.\n",
        one.case_name, one.method, ratio->cheap->setting->name(), two_digits(ratio->times),
        ratio->dear->setting->method, ratio->dear->setting->name(), report::seconds(ratio->cheap->cost.cpu),
        report::seconds(ratio->dear->cost.cpu), report::percent(*ratio->cheap->error[stress]),
        two_digits(one.times), report::whole_percent(one.error),
        ratio->times >= one.times ? "reached" : "not reached");
}

std::string recommendations(const std::vector<CaseRows>& cases) {
    Table table{{"method", "setting"}};
    for (const CaseRows& one : cases) table.front().push_back(one.of->name);
    for (const std::string& method : methods_of(cases)) {
        const Setting* setting = recommended(cases, method);
        table.push_back({method, setting ? setting->name() : "none"});
        for (const CaseRows& one : cases) {
            const Row* row = setting ? row_of(one, *setting) : nullptr;
            table.back().push_back(
                row && is_eligible(*row)
                    ? fmt::format("{}, {}", error_cell(one, *row, stress), report::seconds(row->cost.cpu))
                    : none);
        }
    }
    return fmt::format(
        "## Recommended settings\n\nOf each method the cheapest setting that is nearly as good as can be on "
        "all cases: the "
        "largest ratio of its error of stress to the method's least is at most {:g} times the smallest such "
        "ratio. Error "
        "of stress and CPU time:\n\n{}\n",
        worse_by, markdown_table(table));
}

std::string cheapest_table(const CaseRows& one) {
    Table table{{"error of stress at most", "cheapest", "CPU time"}};
    const std::vector<std::string> names = methods_of({one});
    for (const std::string& name : names) table.front().push_back(name);
    for (const double target : targets) {
        const Row* best = cheapest(one, target);
        table.push_back({report::whole_percent(target), none, none});
        if (best) {
            table.back()[1] = fmt::format("{}, {}", best->setting->method, best->setting->name());
            table.back()[2] = report::seconds(best->cost.cpu);
        }
        for (const std::string& name : names) {
            const Row* own = cheapest(one, target, name);
            table.back().push_back(
                own ? fmt::format("{} ({})", two_digits(own->cost.cpu / best->cost.cpu), own->setting->name())
                    : none);
        }
    }
    return markdown_table(table);
}

std::string all_settings(const CaseRows& one) {
    const auto front = pareto_front(one);
    std::optional<double> least;
    for (const Row& row : one.rows)
        if (row.report.steps > 0) least = std::min(least.value_or(row.cost.cpu), row.cost.cpu);
    Table table{{"setting", "CPU time / least", "CPU time", "memory", "covered"}};
    for (std::size_t q = 0; q < quantity_count; ++q)
        if (one.of->quantities[q])
            table.front().push_back(fmt::format("error of {}", quantity_names[q].title));
    table.front().emplace_back("ended");
    for (std::size_t k = 0; k < one.rows.size(); ++k) {
        const Row& row = one.rows[k];
        const bool ran = row.report.steps > 0, is_best = std::ranges::find(front, k) != front.end();
        table.push_back(
            {fmt::format("{}{}, {}", is_best ? "* " : "", row.setting->method, row.setting->name()),
             ran && *least > 0.0 ? two_digits(row.cost.cpu / *least) : none,
             ran ? report::seconds(row.cost.cpu) : none,
             ran ? fmt::format("{:.0f} MB", row.cost.memory / 1e6) : none,
             report::whole_percent(row.coverage)});
        for (std::size_t q = 0; q < quantity_count; ++q)
            if (one.of->quantities[q]) table.back().push_back(error_cell(one, row, q));
        table.back().emplace_back(ended_in_short(row.report));
    }
    return markdown_table(table);
}

std::string case_section(const CaseRows& one) {
    std::vector<std::string> own;
    for (std::size_t q = 0; q < quantity_count; ++q)
        if (one.own_error[q])
            own.push_back(fmt::format("{} {}", quantity_names[q].title, report::percent(*one.own_error[q])));
    return fmt::format(
        "## {}\n\n`{}`, against `{}`; the reference's own error: {}.\n\nThe cheapest setting within an "
        "error, "
        "and of each method its CPU time / that of the cheapest:\n\n{}\nAll settings (* on the Pareto front; "
        "own: at the reference's own error):\n\n{}\n",
        one.of->title, one.of->name, one.of->reference.filename().string(),
        own.empty() ? "not known" : report::listed(own), cheapest_table(one), all_settings(one));
}

/// How far repeats are apart, so that a reader knows what a ratio is worth.
std::string measured_on(const std::vector<CaseRows>& cases) {
    std::vector<double> spread;
    std::size_t repeats = 0;
    bool all_repeated = true;
    const RunReport* first = nullptr;
    for (const CaseRows& one : cases)
        for (const Row& row : one.rows) {
            repeats = std::max(repeats, row.repeats);
            if (row.report.steps == 0 || row.cost.cpu_min <= 0.0) continue;
            if (row.repeats < repeats) {
                all_repeated = false;
                continue;
            }
            if (!first) first = &row.report;
            spread.push_back(row.cost.cpu_max / row.cost.cpu_min);
        }
    if (!first) return "No run made a step.\n";
    return fmt::format(
        "{}, {}; softgrain {} ({}), {}. Each run is a process of its own with one thread; CPU times are "
        "medians of {}, interleaved{}; the largest over the least is {:.2f} (median over the settings), at "
        "most {:.2f}.\n",
        first->processor, first->finished, first->version, first->commit, compiler, repeats,
        all_repeated ? "" : " (long runs: once)", median(spread), *std::ranges::max_element(spread));
}

}  // namespace

std::string error_csv(const std::vector<CaseRows>& cases) {
    std::string text =
        "case,method,knob,setting,keys,cpu_time,cpu_time_min,cpu_time_max,repeats,wall_time,peak_memory,"
        "steps,coverage";
    for (const QuantityName& one : quantity_names) text += fmt::format(",{0}_error,{0}_own_error", one.key);
    text += ",ended,exit_code,machine,compiler,version,commit,date\n";
    for (const CaseRows& one : cases)
        for (const Row& row : one.rows) {
            const RunReport& r = row.report;
            text += fmt::format(
                "{},{},{},{},{},{:.6g},{:.6g},{:.6g},{},{:.6g},{:.0f},{},{:.4f}", one.of->name,
                row.setting->method, quoted(row.setting->knob), quoted(row.setting->label),
                quoted(fmt::format("{}", fmt::join(row.setting->set, " "))), row.cost.cpu, row.cost.cpu_min,
                row.cost.cpu_max, row.repeats, row.cost.wall, row.cost.memory, r.steps, row.coverage);
            for (std::size_t q = 0; q < quantity_count; ++q)
                text += fmt::format(",{},{}", number(row.error[q]), number(one.own_error[q]));
            text += fmt::format(",{},{},{},{},{},{},{}\n", quoted(r.ended), r.exit_code, quoted(r.processor),
                                quoted(compiler), r.version, r.commit, r.finished);
        }
    return text;
}

std::string error_markdown(const Plan& plan, const std::vector<CaseRows>& cases) {
    std::string text = "# Error against cost\n\n" + measured_on(cases) + "\n";
    for (const Headline& one : plan.headlines) text += headline(one, cases);
    if (!plan.headlines.empty()) text += "\n";
    text += recommendations(cases);
    for (const CaseRows& one : cases) text += case_section(one);
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

}  // namespace softgrain::bench
