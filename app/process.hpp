#pragma once
// What the operating system knows of this process: clocks, memory, signals, terminal.
#include <atomic>
#include <cstdint>

namespace softgrain {

/// Signal number that asked the process to stop, or 0. Set by SIGINT and SIGTERM once install_stop_signals()
/// was called.
const std::atomic<int>& stop_signal();
void install_stop_signals();

double wall_clock();  ///< [s], monotonic
double cpu_clock();   ///< user + system time of all threads [s]

/// Forget the largest memory use so far, so that the next call of peak_memory() is about what follows.
void reset_peak_memory();
std::uint64_t peak_memory();  ///< largest resident set since the last reset [bytes]; 0 if unknown

bool stderr_is_terminal();

}  // namespace softgrain
