#pragma once
// `softgrain bench scaling`: cost and memory of a grain over the number of grains, and where the time goes.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

struct ScalingRequest {
    std::filesystem::path plan;
    std::vector<std::string> methods;  ///< subjects by name; empty for all
    int most_grains = 1000000;
    int repeats = 3;
    double most_seconds = 180.0;  ///< of a run
    std::filesystem::path folder;
    bool force = false;          ///< replace results that are there
    bool packings_only = false;  ///< make the packings and run nothing
};

/// Writes scaling.csv, roofline.csv, scaling.md and plots into the folder. Runs that fail or would not fit
/// are rows with their reason. Returns the exit code: 0, or 130 or 143 if stopped, without results then.
/// Throws InputError and OutputError.
int bench_scaling(const ScalingRequest& request);

}  // namespace softgrain::bench
