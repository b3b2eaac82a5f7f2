#pragma once
// `softgrain bench error`: error against cost for every method and setting of a plan.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

struct ErrorRequest {
    std::filesystem::path plan;
    std::vector<std::string> cases;    ///< names; empty for all
    std::vector<std::string> methods;  ///< empty for all
    int repeats = 3;
    double repeat_below = 60.0;  ///< CPU time above which a run is not repeated [s]
    std::filesystem::path folder;
    bool resume = false;
    bool force = false;  ///< replace results that are there
};

/// Runs the plan and writes error.csv, error.md and plots into the folder. A run that fails is a row with its
/// reason. Returns the exit code: 0, or 130 or 143 if stopped, without results then. Throws InputError and
/// OutputError.
int bench_error(const ErrorRequest& request);

}  // namespace softgrain::bench
