#pragma once
// A stop asked for from outside, as by a signal, and how work that takes long heeds it.
#include <atomic>
#include <stdexcept>

namespace softgrain {

/// Why the work under way is to end soon, as the number of a signal; 0 while it is not. One for the whole
/// process; a signal handler may set it.
std::atomic<int>& stop_request();

/// The work was given up because of stop_request().
class StopAsked : public std::runtime_error {
  public:
    StopAsked();
};

/// Throws StopAsked if a stop is asked for. An exception must not leave a parallel region.
void heed_stop();

}  // namespace softgrain
