#pragma once
// `softgrain bench steps`: what a number of steps of a scenario costs, after others that only prepare it.
#include <filesystem>
#include <string>
#include <vector>

namespace softgrain::bench {

struct StepsRequest {
    std::filesystem::path scenario;
    std::vector<std::string> set;  ///< KEY=VALUE
    std::string method;
    int threads = 1;
    int warm_up = 1;  ///< steps before those that are measured, >= 1
    int steps = 1;    ///< >= 1
};

struct StepsReport {
    std::string method;
    std::size_t grains = 0;
    int threads = 1;
    long long steps = 0;
    double wall = 0.0, cpu = 0.0;      ///< of the steps alone [s]
    double began = 0.0, ended = 0.0;   ///< wall_clock() at their begin and end [s]
    double whole_wall = 0.0;           ///< from reading the scenario to the last step [s]
    double memory = 0.0;               ///< most that the method held, without its packing [bytes]
    double coordination_number = 0.0;  ///< at the end
    std::string processor, finished;   ///< see RunReport
    std::string version, commit;       ///< of softgrain
};

/// One time loop without files. Throws InputError, also if the loading ends before the steps are made or a
/// signal stops it, and DivergedError.
StepsReport measure_steps(const StepsRequest& request);

std::string to_json(const StepsReport& report);
/// Throws InputError if the text is not such a report.
StepsReport steps_report(const std::string& json);

}  // namespace softgrain::bench
