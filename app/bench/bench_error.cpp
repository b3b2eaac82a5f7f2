#include "app/bench/bench_error.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/plots.hpp"
#include "app/bench/results_folder.hpp"
#include "app/bench/tables.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {
namespace {

/// Leaves out what was not asked for.
void choose(Plan& plan, const ErrorRequest& request) {
    for (const std::string& name : request.cases)
        if (std::ranges::find(plan.cases, name, &Case::name) == plan.cases.end()) {
            std::vector<std::string> names;
            for (const Case& one : plan.cases) names.push_back(one.name);
            throw InputError(fmt::format("--case {}: {} has no such case, it has {}", name,
                                         plan.source.string(), fmt::join(names, ", ")));
        }
    for (const std::string& name : request.methods) find_method(name);
    const auto is_asked = [](const std::vector<std::string>& asked, const std::string& name) {
        return asked.empty() || std::ranges::find(asked, name) != asked.end();
    };
    std::erase_if(plan.cases, [&](const Case& one) { return !is_asked(request.cases, one.name); });
    std::erase_if(plan.settings, [&](const Setting& one) { return !is_asked(request.methods, one.method); });
}

}  // namespace

int bench_error(const ErrorRequest& request) {
    Plan plan = read_plan(request.plan);
    choose(plan, request);
    if (std::filesystem::exists(request.folder / "runs")) {
        if (!request.resume && !request.force)
            throw InputError(
                fmt::format("{}: holds results already; go on with --resume, replace them with --force, or "
                            "choose another --out",
                            request.folder.string()));
        if (!request.resume) std::filesystem::remove_all(request.folder / "runs");
    }
    make_directories(request.folder);
    for (const Case& one : plan.cases)
        if (!one.truth)
            fmt::print("{}: left out, its reference {} is not there\n", one.name, one.reference.string());

    const auto measured = run_plan(plan, {.folder = request.folder,
                                          .repeats = request.repeats,
                                          .repeat_below = request.repeat_below,
                                          .resume = request.resume});
    if (stop_signal() != 0) {
        fmt::print(stderr, "stopped by a signal; go on with --resume\n");
        return 128 + stop_signal();
    }
    const auto cases = rows_by_case(measured);
    if (cases.empty()) throw InputError(fmt::format("{}: nothing to run is left", plan.source.string()));
    write_file_atomically(request.folder / "error.csv", error_csv(cases));
    const std::string tables = error_markdown(plan, cases);
    write_file_atomically(request.folder / "error.md", tables);
    for (const CaseRows& one : cases)
        for (std::size_t q = 0; q < quantity_count; ++q)
            if (const auto plot = error_plot(one, q))
                draw(*plot, request.folder, fmt::format("{}_{}", one.of->name, quantity_names[q].key));
    fmt::print("\n{}\nResults in {}\n", tables, request.folder.string());
    return 0;
}

}  // namespace softgrain::bench
