#pragma once
// Runs a plan: each setting a process of its own with one thread, all settings once, then all again.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench/plan.hpp"
#include "app/run_folder.hpp"

namespace softgrain::bench {

struct RunnerOptions {
    std::filesystem::path folder;  ///< runs go to folder/runs/CASE/SETTING/REPEAT
    int repeats = 3;
    double repeat_below = 60.0;  ///< CPU time above which a run is not repeated [s]
    bool resume = false;         ///< keep runs that are finished and of the same scenario
};

/// A setting on a case.
struct Measurement {
    const Case* of;
    const Setting* setting;
    std::vector<RunReport> repeats;  ///< exit_code 2 and why in `ended` if the method refused the scenario
    std::optional<History> history;  ///< none if no step was made
};

/// How a run ended, without what comes after the colon.
std::string_view ended_in_short(const RunReport& report);

/// Runs all settings on all cases that have their reference, in the order of the plan, and prints a line for
/// each run. Throws InputError before the first run if a scenario is not sound. Ends early once stop_signal()
/// is set.
std::vector<Measurement> run_plan(const Plan& plan, const RunnerOptions& options);

}  // namespace softgrain::bench
