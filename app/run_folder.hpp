#pragma once
// One method, one scenario, one folder: history.csv, run.h5, VTK series, scenario.toml, run.json.
#include <filesystem>
#include <string>
#include <vector>

#include "common/packing/packing.hpp"
#include "common/scenario.hpp"
#include "common/solver.hpp"

namespace softgrain {

struct RunRequest {
    const Scenario& scenario;  ///< as read; the method's own rate is applied here
    const Packing& packing;
    const Method& method;
    std::filesystem::path folder;
    /// Folder of a finished run of the stages before the last one, to start from; empty for the start.
    std::filesystem::path from = {};
    int threads = 1;
    bool resume = false;              ///< go on from the folder's checkpoint if there is one
    bool force = false;               ///< replace results that are there
    double checkpoint_period = 60.0;  ///< wall time between checkpoints [s]
    bool quiet = false;
    std::vector<std::string> measures = {};  ///< to write besides those of the scenario, see MeasureWriter
};

struct RunReport {
    std::string method;
    std::string ended;  ///< "loading done", "left its range ...", "stopped by signal", "diverged: ..."
    int exit_code = 0;
    bool has_results = true;  ///< false if the method could not begin: nothing was written
    std::size_t grains = 0;
    long long steps = 0;
    double simulated_time = 0.0;        ///< [s]
    double wall_time = 0.0;             ///< [s], before and after a resume
    double cpu_time = 0.0;              ///< [s]
    double peak_memory = 0.0;           ///< [bytes]
    std::string version, commit;        ///< of softgrain
    int threads = 1;                    ///< most that were used
    std::string processor;              ///< "2 x NAME"; empty if unknown
    std::string finished;               ///< date and time in UTC; empty if unknown
    std::vector<std::string> warnings;  ///< of the watch, a line for each broken limit; and of lost files
    std::string last_state_hash;  ///< state_hash() of the last sample in hexadecimal digits; empty if unknown
};

/// Throws InputError if the folder holds results of a run.
void refuse_to_overwrite(const std::filesystem::path& folder);

/// Runs and writes. Divergence and signals are reported, not thrown, and so are a scenario that the method
/// refuses (exit_code 2) and grains that it cannot prepare (exit_code 3, or that of a signal meanwhile),
/// after which nothing was written. Throws InputError about the folder, and OutputError.
RunReport run_into_folder(const RunRequest& request);

/// Report of an earlier run from its run.json. Throws InputError.
RunReport read_report(const std::filesystem::path& folder);

}  // namespace softgrain
