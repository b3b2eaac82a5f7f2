#include "app/bench/stability/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "app/bench/rows.hpp"
#include "app/markdown_table.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "app/report/words.hpp"
#include "version.hpp"

namespace softgrain::bench {
namespace {

using Table = std::vector<std::vector<std::string>>;

constexpr double wasteful = 2.0;
constexpr std::array<std::string_view, 3> long_titles{"energy drift", "closed cycle", "held at rest"};

std::string measured_on() {
    return fmt::format("softgrain {} ({}), {}, {}, {}", version, commit, compiler, processor_name(),
                       date_and_time());
}

std::string csv_head(std::string_view columns) {
    return fmt::format("# {}\n{}\n", measured_on(), columns);
}

/// As a field of a CSV file: one line, in quotation marks.
std::string quoted(std::string text) {
    std::ranges::replace(text, '"', '\'');
    std::ranges::replace(text, '\n', ' ');
    return "\"" + text + "\"";
}

std::string keys_of(const std::vector<std::string>& set) {
    return fmt::format("{}", fmt::join(set, " "));
}

/// In Markdown, without what would end a cell.
std::string cell(std::string text) {
    std::ranges::replace(text, '|', '/');
    return text.empty() ? "-" : text.substr(0, text.find('\n'));
}

std::string damping_of(const MapRow& row) {
    return row.cell.damping.empty() ? "default" : row.cell.damping;
}

std::string place_of(const MapRow& row) {
    return fmt::format("phi {:g}, nu {:g}, sizes 1:{:g}, stiffness 1:{:g}, {}", row.cell.phi,
                       row.cell.poisson_ratio, row.cell.size_ratio, row.cell.stiffness_ratio,
                       damping_of(row));
}

std::vector<const MapRow*> measured(const std::vector<MapRow>& rows, const MapPlan* plan = nullptr) {
    std::vector<const MapRow*> some;
    for (const MapRow& row : rows)
        if (row.not_measured.empty() && (plan == nullptr || row.plan == plan)) some.push_back(&row);
    return some;
}

std::string map_section(const std::vector<MapRow>& rows) {
    std::vector<const MapPlan*> plans;
    for (const MapRow& row : rows)
        if (plans.empty() || plans.back() != row.plan) plans.push_back(row.plan);
    const auto waste = [](const MapRow* row) { return row->waste(); };
    const auto all = measured(rows);
    std::string text = "## Largest stable step\n\n";
    if (!all.empty()) {
        const auto [least, most] = std::ranges::minmax(all, {}, waste);
        const auto count = [&](auto&& is) { return std::ranges::count_if(all, is); };
        text += fmt::format(
            "- Largest stable step / default step, over {} scenes: **{:.2f}** ({}: {}) to **{:.2f}** ({}: "
            "{}).\n"
            "- The default is unstable in {} of them, and wastes more than a factor {:g} in {}.\n\n",
            all.size(), least->waste(), least->plan->name, place_of(*least), most->waste(), most->plan->name,
            place_of(*most), count([](const MapRow* r) { return r->waste() < 1.0; }), wasteful,
            count([](const MapRow* r) { return r->waste() > wasteful; }));
    }
    Table table{{"map and damping", "scenes", "default / predicted", "stable / predicted", "stable / default",
                 "unstable", fmt::format("wastes > {:g}", wasteful), "not measured"}};
    for (const MapPlan* plan : plans)
        for (const std::string& damping : plan->damping) {
            auto some = measured(rows, plan);
            std::erase_if(some, [&](const MapRow* r) { return r->cell.damping != damping; });
            const auto missing = std::ranges::count_if(rows, [&](const MapRow& r) {
                return r.plan == plan && r.cell.damping == damping && !r.not_measured.empty();
            });
            table.push_back({fmt::format("{}, {}", plan->name, damping.empty() ? "default" : damping),
                             fmt::format("{}", some.size())});
            std::vector<std::string>& row = table.back();
            if (some.empty()) {
                row.insert(row.end(), {"-", "-", "-", "-", "-", fmt::format("{}", missing)});
                continue;
            }
            const auto range = [&](auto&& of) {
                const auto [a, b] = std::ranges::minmax(some, {}, of);
                return fmt::format("{:.2f} to {:.2f}", of(a), of(b));
            };
            row.push_back(range([](const MapRow* r) { return r->safety; }));
            row.push_back(range([](const MapRow* r) { return r->largest; }));
            row.push_back(range(waste));
            row.push_back(
                fmt::format("{}", std::ranges::count_if(some, [](auto* r) { return r->waste() < 1.0; })));
            row.push_back(fmt::format(
                "{}", std::ranges::count_if(some, [](auto* r) { return r->waste() > wasteful; })));
            row.push_back(fmt::format("{}", missing));
        }
    return text + markdown_table(table) + "\n";
}

std::string long_section(const std::vector<LongRow>& rows) {
    Table table{{"run", "what", "steps", "waves through a grain", "change", "largest"}};
    for (const LongRow& row : rows) {
        table.push_back({row.plan->name, std::string(long_titles[static_cast<std::size_t>(row.plan->kind)])});
        std::vector<std::string>& cells = table.back();
        if (row.failed.empty())
            cells.insert(cells.end(),
                         {fmt::format("{}", row.steps), report::significant(row.waves),
                          fmt::format("{:.2g}", row.change), fmt::format("{:.2g}", row.largest)});
        else
            cells.insert(cells.end(), {"-", "-", "-", cell(row.failed)});
    }
    return "## Long runs\n\n" + markdown_table(table) + "\n";
}

/// In two words; the reasons are in the CSV file.
std::string how_it_ended(const WatchedRun& run) {
    constexpr std::string_view left = "left its range";
    return std::string(run.ending == Ending::done && run.reason.starts_with(left) ? left
                                                                                  : name_of(run.ending));
}

std::string extremes_section(const std::vector<ExtremeRow>& rows) {
    Table table{{"extreme"}};
    for (const Method& method : methods()) table.front().emplace_back(method.name);
    for (const ExtremeRow& row : rows) {
        if (table.back().front() != row.of->name) {
            table.emplace_back(table.front().size(), "-");
            table.back().front() = row.of->name;
        }
        const auto column = std::ranges::find(table.front(), row.method) - table.front().begin();
        table.back()[static_cast<std::size_t>(column)] = how_it_ended(row.run);
    }
    return "## Extremes\n\n" + markdown_table(table) + "\n";
}

std::string random_section(const std::vector<RandomRow>& rows) {
    std::map<std::string, std::map<Ending, int>> counts;
    std::size_t drawn = 0;
    for (const RandomRow& row : rows) {
        ++counts[row.method][row.run.ending];
        drawn += row.refused_draws;
    }
    Table table{{"method"}};
    constexpr int endings = static_cast<int>(Ending::other_exit) + 1;
    for (int e = 0; e < endings; ++e) table.front().emplace_back(name_of(static_cast<Ending>(e)));
    for (const Method& method : methods()) {
        const auto own = counts.find(std::string(method.name));
        if (own == counts.end()) continue;
        table.push_back({own->first});
        for (int e = 0; e < endings; ++e)
            table.back().push_back(fmt::format("{}", own->second[static_cast<Ending>(e)]));
    }
    return fmt::format(
        "## Random scenarios\n\n{} scenarios, each a process of its own; the reader refused {} others "
        "before, each "
        "with a reason. Columns from \"crashed\" on are failures of the program.\n\n{}\n",
        rows.size(), drawn, markdown_table(table));
}

}  // namespace

std::size_t failures_of(const StabilityResults& results) {
    const auto failed = [](const auto& row) { return is_failure(row.run.ending); };
    return static_cast<std::size_t>(std::ranges::count_if(results.extremes, failed) +
                                    std::ranges::count_if(results.random, failed));
}

std::string map_csv(const std::vector<MapRow>& rows) {
    std::string text = csv_head(
        "map,method,keys,damping,phi,poisson_ratio,size_ratio,stiffness_ratio,stable_over_default,"
        "stable_over_predicted,default_over_predicted,default_step,not_measured");
    for (const MapRow& r : rows) {
        text += fmt::format("{},{},{},{},{},{},{},{},", r.plan->name, r.plan->method,
                            quoted(keys_of(r.plan->set)), quoted(damping_of(r)), r.cell.phi,
                            r.cell.poisson_ratio, r.cell.size_ratio, r.cell.stiffness_ratio);
        if (r.not_measured.empty())
            text += fmt::format("{:.4g},{:.4g},{:.4g},{:.6g},\n", r.waste(), r.largest, r.safety, r.step);
        else
            text += fmt::format(",,,,{}\n", quoted(r.not_measured));
    }
    return text;
}

std::string long_csv(const std::vector<LongRow>& rows) {
    std::string text = csv_head("run,kind,method,keys,phi,strain,steps,waves,change,largest,failed");
    for (const LongRow& r : rows)
        text += fmt::format("{},{},{},{},{},{},{},{:.6g},{:.6g},{:.6g},{}\n", r.plan->name,
                            quoted(std::string(long_titles[static_cast<std::size_t>(r.plan->kind)])),
                            r.plan->scene.method, quoted(keys_of(r.plan->scene.set)), r.plan->phi,
                            r.plan->strain, r.steps, r.waves, r.change, r.largest, quoted(r.failed));
    return text;
}

std::string extremes_csv(const std::vector<ExtremeRow>& rows) {
    std::string text = csv_head(
        "extreme,method,keys,ended,exit_code,steps,cpu_time,packing_fraction,mean_stress,kinetic_energy,"
        "reason");
    for (const ExtremeRow& r : rows) {
        text += fmt::format("{},{},{},{},{},{},{:.4g}", r.of->name, r.method, quoted(keys_of(r.of->set)),
                            name_of(r.run.ending), r.run.exit_code, r.run.steps, r.run.cpu_time);
        for (const char* column : {"packing_fraction", "mean_stress", "kinetic_energy"}) {
            const auto value = r.run.last.find(column);
            text += value == r.run.last.end() ? "," : fmt::format(",{:.6g}", value->second);
        }
        text += fmt::format(",{}\n", quoted(r.run.reason));
    }
    return text;
}

std::string random_csv(const std::vector<RandomRow>& rows) {
    std::string text = csv_head("seed,method,refused_draws,ended,exit_code,steps,cpu_time,reason");
    for (const RandomRow& r : rows)
        text += fmt::format("{},{},{},{},{},{},{:.4g},{}\n", r.seed, r.method, r.refused_draws,
                            name_of(r.run.ending), r.run.exit_code, r.run.steps, r.run.cpu_time,
                            quoted(r.run.reason));
    return text;
}

std::string stability_markdown(const StabilityResults& results) {
    std::string text = fmt::format("# Stability\n\n{}.\n\n", measured_on());
    if (!results.map.empty()) text += map_section(results.map);
    if (!results.long_runs.empty()) text += long_section(results.long_runs);
    if (!results.extremes.empty()) text += extremes_section(results.extremes);
    if (!results.random.empty()) text += random_section(results.random);
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

}  // namespace softgrain::bench
