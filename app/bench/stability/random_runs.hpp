#pragma once
// Random scenarios, each as a process of its own.
#include <filesystem>
#include <vector>

#include "app/bench/stability/watched_run.hpp"

namespace softgrain::bench {

struct RandomPlan {
    int first_seed = 1;
    int scenarios = 0;  ///< of each method
    ChildLimits limits{};
};

struct RandomRow {
    int seed;
    std::string method;
    std::size_t refused_draws;  ///< scenarios that the reader refused before it accepted one
    WatchedRun run;
};

/// Runs and prints a line for each failure. Scenarios of failures stay in the folder with their results. Ends
/// early once stop_signal() is set.
std::vector<RandomRow> random_runs(const RandomPlan& plan, const std::vector<std::string>& methods,
                                   const std::filesystem::path& folder);

}  // namespace softgrain::bench
