#pragma once
// A stop that is asked for while the test does something that takes long.
#include <chrono>
#include <csignal>
#include <thread>

#include "common/stop.hpp"

namespace softgrain::testing {

inline double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Asks for it after so many seconds; takes it back at the end.
class StopLater {
  public:
    explicit StopLater(double seconds)
        : asking_([seconds, this] {
              std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
              asked_ = std::chrono::steady_clock::now();
              stop_request() = SIGTERM;
          }) {}
    StopLater(const StopLater&) = delete;
    StopLater& operator=(const StopLater&) = delete;
    ~StopLater() {
        asking_.join();
        stop_request() = 0;
    }
    /// Since the stop was asked for, which it must have been [s].
    double latency() const { return seconds_since(asked_); }

  private:
    std::chrono::steady_clock::time_point asked_;  // before the thread that writes it
    std::thread asking_;
};

}  // namespace softgrain::testing
