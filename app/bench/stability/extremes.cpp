#include "app/bench/stability/extremes.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/process.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {

std::vector<ExtremeRow> extreme_runs(const ExtremesPlan& plan, const std::vector<std::string>& methods,
                                     const std::filesystem::path& folder) {
    make_directories(folder);
    std::vector<ExtremeRow> rows;
    for (const Extreme& one : plan.extremes)
        for (const std::string& method : methods) {
            if (stop_signal() != 0) return rows;
            if (!one.methods.empty() && std::ranges::find(one.methods, method) == one.methods.end()) continue;
            rows.push_back({&one, method,
                            watch_run({one.scenario, one.set, method},
                                      folder / fmt::format("{}_{}", one.name, method), plan.limits)});
            const WatchedRun& run = rows.back().run;
            fmt::print("{}, {}: {}, {}\n", one.name, method, name_of(run.ending), run.reason);
            std::fflush(stdout);
        }
    return rows;
}

}  // namespace softgrain::bench
