#include "app/bench/scaling/bench_scaling.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/results_folder.hpp"
#include "app/bench/scaling/machine_limits.hpp"
#include "app/bench/scaling/scaling_run.hpp"
#include "app/bench/scaling/scaling_tables.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {
namespace {

/// Leaves out what was not asked for.
void choose(ScalingPlan& plan, const ScalingRequest& request) {
    std::vector<std::string> names;
    for (const Subject& one : plan.subjects) names.push_back(one.name);
    for (const std::string& name : request.methods)
        if (std::ranges::find(names, name) == names.end())
            throw InputError(fmt::format("--method {}: {} has no such subject, it has {}", name,
                                         plan.source.string(), fmt::join(names, ", ")));
    std::erase_if(plan.subjects, [&](const Subject& one) {
        return !request.methods.empty() &&
               std::ranges::find(request.methods, one.name) == request.methods.end();
    });
    for (Subject& subject : plan.subjects)
        std::erase_if(subject.counts, [&](int count) { return count > request.most_grains; });
    std::erase_if(plan.subjects, [](const Subject& one) { return one.counts.empty(); });
    if (plan.subjects.empty())
        throw InputError(fmt::format("{}: nothing to run is left", plan.source.string()));
}

}  // namespace

int bench_scaling(const ScalingRequest& request) {
    ScalingPlan plan = read_scaling_plan(request.plan);
    choose(plan, request);
    refuse_to_replace(request.folder / "scaling.csv", request.force);
    make_directories(request.folder);
    if (request.packings_only) {
        make_packings(plan, request.folder);
        return 0;
    }
    const MachineLimits limits = machine_limits();
    const ScalingResults results = run_scaling(
        plan, {.folder = request.folder, .repeats = request.repeats, .most_seconds = request.most_seconds});
    if (stop_signal() != 0) {
        fmt::print(stderr, "stopped by a signal, without results\n");
        return 128 + stop_signal();
    }
    const std::string tables = scaling_markdown(plan, results, limits);
    write_file_atomically(request.folder / "scaling.csv", scaling_csv(results));
    write_file_atomically(request.folder / "roofline.csv",
                          roofline_csv(roofline(plan, results, limits), limits));
    write_file_atomically(request.folder / "scaling.md", tables);
    for (const NamedPlot& one : scaling_plots(plan, results, limits))
        draw(one.plot, request.folder, one.name);
    fmt::print("\n{}\nResults in {}\n", tables, request.folder.string());
    return 0;
}

}  // namespace softgrain::bench
