#include "app/bench/stability/bench_stability.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/results_folder.hpp"
#include "app/bench/stability/plan.hpp"
#include "app/bench/stability/plots.hpp"
#include "app/bench/stability/tables.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {
namespace {

std::vector<std::string> methods_of(const StabilityRequest& request) {
    for (const std::string& name : request.methods) find_method(name);
    if (!request.methods.empty()) return request.methods;
    std::vector<std::string> all;
    for (const Method& m : methods()) all.emplace_back(m.name);
    return all;
}

void write_results(const StabilityPlan& plan, const StabilityResults& results,
                   const std::filesystem::path& folder) {
    if (!results.map.empty()) write_file_atomically(folder / "map.csv", map_csv(results.map));
    if (!results.long_runs.empty()) write_file_atomically(folder / "long.csv", long_csv(results.long_runs));
    if (!results.extremes.empty())
        write_file_atomically(folder / "extremes.csv", extremes_csv(results.extremes));
    if (!results.random.empty()) write_file_atomically(folder / "random.csv", random_csv(results.random));
    for (const MapPlan& map : plan.maps)
        if (const auto plot = map_plot(results.map, map)) draw(*plot, folder, "map_" + map.name);
    const std::string tables = stability_markdown(results);
    write_file_atomically(folder / "stability.md", tables);
    fmt::print("\n{}\nResults in {}\n", tables, folder.string());
}

}  // namespace

int bench_stability(const StabilityRequest& request) {
    const StabilityPlan plan = read_stability_plan(request.plan);
    const std::vector<std::string> methods = methods_of(request);
    const auto wants = [&](const char* part) {
        return request.parts.empty() || std::ranges::find(request.parts, part) != request.parts.end();
    };
    refuse_to_replace(request.folder / "stability.md", request.force);
    make_directories(request.folder);
    StabilityResults results;
    if (wants("random")) results.random = random_runs(plan.random, methods, request.folder / "random");
    if (wants("extremes"))
        results.extremes = extreme_runs(plan.extremes, methods, request.folder / "extremes");
    if (wants("map"))
        for (const MapPlan& map : plan.maps)
            if (std::ranges::find(methods, map.method) != methods.end())
                std::ranges::move(step_map(map), std::back_inserter(results.map));
    if (wants("long")) results.long_runs = long_runs(plan.long_runs, methods);
    if (stop_signal() != 0) {
        fmt::print(stderr, "stopped by a signal\n");
        return 128 + stop_signal();
    }
    write_results(plan, results, request.folder);
    return failures_of(results) == 0 ? 0 : 1;
}

}  // namespace softgrain::bench
