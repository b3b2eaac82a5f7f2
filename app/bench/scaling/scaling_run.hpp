#pragma once
// Runs a scaling plan: each run a process of its own, all once, then all again.
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/scaling/scaling_plan.hpp"
#include "app/bench/scaling/steps.hpp"

namespace softgrain::bench {

/// A subject with a number of grains and threads.
struct ScalingPoint {
    const Subject* of;
    int count, threads;
    std::vector<StepsReport> repeats;
    std::string failure;  ///< why there are no repeats; empty if there are

    /// Medians of the repeats.
    double cpu() const;     ///< of a grain-step [s]
    double wall() const;    ///< of a grain-step [s]
    double memory() const;  ///< of a grain [bytes]
    /// Largest CPU time of a repeat / least.
    double spread() const;
};

/// Where the time of a subject goes: shares of the samples by function.
using Profile = std::map<std::string, double>;

struct ScalingResults {
    std::vector<ScalingPoint> points;               ///< in the order of the plan
    std::map<std::string, Profile> profiles;        ///< by the subject's name
    std::map<std::string, std::string> unprofiled;  ///< by the subject's name, why it has no profile

    /// Null if it was not run or failed.
    const ScalingPoint* find(const Subject& subject, int count, int threads) const;
};

struct ScalingOptions {
    std::filesystem::path folder;  ///< packings go to folder/packings
    int repeats;
    double most_seconds;  ///< of a run; more is not begun, as far as the smaller runs tell
};

/// All packings of a plan, as FOLDER/packings/SCENARIO_COUNT.csv. Throws InputError and OutputError.
void make_packings(const ScalingPlan& plan, const std::filesystem::path& folder);

/// Prints a line for each run. Runs that would not fit are left out with their reason. Ends early once
/// stop_signal() is set. Throws InputError and OutputError.
ScalingResults run_scaling(const ScalingPlan& plan, const ScalingOptions& options);

/// Why a run of `count` grains is not begun, judged by one of fewer grains of the same subject.
std::optional<std::string> does_not_fit(const StepsReport& smaller, const Subject& subject, int count,
                                        double most_seconds, double available_memory);

/// The table that `perf report --no-children -F overhead,sym` prints, as shares of 1.
Profile read_profile(const std::string& table);

}  // namespace softgrain::bench
