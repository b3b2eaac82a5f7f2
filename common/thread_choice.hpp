#pragma once
// Whether threads pay off, decided from measured times: it depends on the size of the work, on the machine,
// and on what else runs there. Where other programs need the cores, a loop shared among threads can take a
// hundred times as long. For work whose results do not depend on the number of threads.
#include <atomic>

namespace softgrain {

/// While one lives, a new ThreadChoice uses threads wherever it may, whatever they cost. For tests that any
/// number of threads gives the same bits.
class ThreadsInAnyCase {
  public:
    ThreadsInAnyCase() { ++living_; }
    ~ThreadsInAnyCase() { --living_; }
    ThreadsInAnyCase(const ThreadsInAnyCase&) = delete;
    ThreadsInAnyCase& operator=(const ThreadsInAnyCase&) = delete;
    static bool wanted() { return living_ > 0; }

  private:
    static inline std::atomic<int> living_ = 0;
};

/// For work done in many rounds that take about the same time each.
class ThreadChoice {
  public:
    /// most_threads: that may be used at all.
    explicit ThreadChoice(int most_threads)
        : parallel_(most_threads > 1 && ThreadsInAnyCase::wanted()),
          decided_(most_threads <= 1 || parallel_) {}

    /// Whether the next round should use threads.
    bool parallel() const { return parallel_; }
    /// Takes note of how long a round took, done as parallel() said [s].
    void note(double seconds);

    /// Rounds between two decisions, and before the first one.
    static constexpr int window = 32, first_look = 4;
    /// Windows without threads after threads have failed: the first time, and at most.
    static constexpr int first_pause = 2, longest_pause = 256;
    /// Windows with threads before their absence is tried again.
    static constexpr int longest_trust = 64;

  private:
    void stop_threads(int pause);

    bool parallel_, decided_;
    int rounds_ = 0, windows_ = 0;  ///< windows since the last change
    int pause_ = first_pause, wait_ = 1;
    double spent_ = 0.0,
           alone_ = -1.0;  ///< time of this window, and of a round without threads; < 0: unknown
};

}  // namespace softgrain
