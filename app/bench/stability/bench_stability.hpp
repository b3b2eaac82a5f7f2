#pragma once
// `softgrain bench stability`: stable steps, long runs, extremes, random scenarios.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

struct StabilityRequest {
    std::filesystem::path plan;
    std::vector<std::string> parts;    ///< random, extremes, map, long; empty for all
    std::vector<std::string> methods;  ///< empty for all
    std::filesystem::path folder;
    bool force = false;  ///< replace results that are there
};

/// Runs the plan and writes a CSV file for each part, stability.md and plots into the folder. Returns the
/// exit code: 0, 1 if a run failed in a way that none may, or 130 or 143 if stopped. Throws InputError and
/// OutputError.
int bench_stability(const StabilityRequest& request);

}  // namespace softgrain::bench
