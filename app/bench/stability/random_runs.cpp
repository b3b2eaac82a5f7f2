#include "app/bench/stability/random_runs.hpp"

#include <fmt/format.h>

#include "app/bench/stability/draw.hpp"
#include "app/process.hpp"
#include "common/io/atomic_file.hpp"

namespace softgrain::bench {

std::vector<RandomRow> random_runs(const RandomPlan& plan, const std::vector<std::string>& methods,
                                   const std::filesystem::path& folder) {
    make_directories(folder);
    std::vector<RandomRow> rows;
    for (int seed = plan.first_seed; seed < plan.first_seed + plan.scenarios; ++seed)
        for (const std::string& method : methods) {
            if (stop_signal() != 0) return rows;
            const std::string name = fmt::format("{}_{}", method, seed);
            const auto file = folder / (name + ".toml");
            const DrawnScenario drawn = draw_scenario(static_cast<std::uint64_t>(seed), method);
            write_file_atomically(file, drawn.text);
            rows.push_back({seed, method, drawn.refused.size(),
                            watch_run({file, {}, method}, folder / name, plan.limits)});
            const WatchedRun& run = rows.back().run;
            if (is_failure(run.ending)) {
                fmt::print("{}: {}, {}\n", file.string(), name_of(run.ending), run.reason);
                std::fflush(stdout);
            } else {
                std::filesystem::remove(file);
            }
        }
    return rows;
}

}  // namespace softgrain::bench
