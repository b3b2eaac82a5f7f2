#pragma once
// Scenarios at the end of what is possible, each as a process of its own.
#include <filesystem>
#include <vector>

#include "app/bench/stability/watched_run.hpp"

namespace softgrain::bench {

struct Extreme {
    std::string name;
    std::filesystem::path scenario;
    std::vector<std::string> set;      ///< KEY=VALUE
    std::vector<std::string> methods;  ///< empty for all
};

struct ExtremesPlan {
    std::vector<Extreme> extremes;
    ChildLimits limits{};
};

struct ExtremeRow {
    const Extreme* of;
    std::string method;
    WatchedRun run;
};

/// Runs and prints a line for each. Ends early once stop_signal() is set.
std::vector<ExtremeRow> extreme_runs(const ExtremesPlan& plan, const std::vector<std::string>& methods,
                                     const std::filesystem::path& folder);

}  // namespace softgrain::bench
