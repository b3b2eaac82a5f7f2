#pragma once
// A scenario as a process of its own, and whether it ended as it should.
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "viz/run_program.hpp"

namespace softgrain::bench {

/// How a run ended. Those from `crashed` on are failures of the program.
enum class Ending {
    done,      ///< exit 0: the loading is done, or the method left its range of validity
    refused,   ///< exit 2 with a reason
    diverged,  ///< exit 3 with a reason
    stopped,   ///< beyond its time, and ended in good order when asked to
    crashed,
    hung,        ///< beyond its time, and did not end in good order when asked to
    not_finite,  ///< in one of its files
    unclear,     ///< no reason, or more than one line
    other_exit,  ///< any other exit code
};
std::string_view name_of(Ending ending);
bool is_failure(Ending ending);

struct RunToWatch {
    std::filesystem::path scenario;
    std::vector<std::string> set;  ///< KEY=VALUE
    std::string method;
};

struct WatchedRun {
    Ending ending;
    int exit_code;                         ///< -1 if it ended by a signal
    std::string reason;                    ///< the program's own word, or what is wrong
    long long steps = 0;                   ///< of run.json; 0 if there is none
    double cpu_time = 0.0;                 ///< [s]
    std::map<std::string, double> last{};  ///< row of the history, by column; empty if there is none
};

/// `softgrain run` of the scenario into the folder, with one thread; all files of the run are looked at. The
/// folder is gone afterwards unless the run is a failure. Throws OutputError.
WatchedRun watch_run(const RunToWatch& what, const std::filesystem::path& folder, const ChildLimits& limits);

}  // namespace softgrain::bench
