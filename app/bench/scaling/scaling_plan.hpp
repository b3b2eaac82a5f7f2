#pragma once
// What `softgrain bench scaling` runs (bench/scaling/README.md).
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

/// A method with one choice of its keys.
struct Subject {
    std::string name, method;
    std::filesystem::path scenario;
    std::vector<std::string> set;  ///< KEY=VALUE
    std::vector<int> counts;       ///< of grains, rising
    std::vector<int> threads;
    int warm_up;        ///< steps before those that are measured
    int least_steps;    ///< that are measured
    double work;        ///< grain-steps that are measured, if that is more
    int profile_count;  ///< grains of the run whose time is divided among functions

    int steps(int count) const;
};

/// A part of a method's step.
struct Kernel {
    std::string method, title;
    std::vector<std::string> functions;  ///< each stands for all whose name contains it
};

/// What a kernel does for a grain in a step, as counted.
struct KernelCount {
    std::string method, title;
    double flops;      ///< double operations
    double bytes;      ///< loaded and stored by instructions
    double far_bytes;  ///< to and from beyond the second cache
};

struct ScalingPlan {
    std::filesystem::path source;
    std::vector<Subject> subjects;
    std::vector<Kernel> kernels;      ///< of kernels.toml beside the plan
    std::vector<KernelCount> counts;  ///< of kernels.csv beside the plan
};

/// Paths in it are looked up from its folder; kernels and counts are none if their files are not there.
/// Throws InputError: a line for each error, with place.
ScalingPlan read_scaling_plan(const std::filesystem::path& path);

}  // namespace softgrain::bench
