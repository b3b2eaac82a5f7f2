#pragma once
// What the operating system knows of this process: clocks, memory, signals, terminal.
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

namespace softgrain {

/// stop_request(): the signal that asked the process to stop since the last install_stop_signals(), or 0. Set
/// by SIGINT, SIGTERM, and SIGHUP unless it is ignored.
const std::atomic<int>& stop_signal();
void install_stop_signals();

double wall_clock();  ///< [s], monotonic
double cpu_clock();   ///< user + system time of all threads [s]

/// Forget the largest memory use so far, so that the next call of peak_memory() is about what follows.
void reset_peak_memory();
std::uint64_t peak_memory();  ///< largest resident set since the last reset [bytes]; 0 if unknown

std::string processor_name();  ///< "2 x NAME", the number of those this process may use; empty if unknown
std::string date_and_time();   ///< now, "2024-05-01 12:30 UTC"

bool stderr_is_terminal();

/// Another program takes this one's place. Throws OutputError if it cannot be started.
[[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments);

}  // namespace softgrain
