#include "app/progress.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/process.hpp"
#include "common/observables/stress.hpp"

namespace softgrain {
namespace {

constexpr double terminal_period = 0.1;  ///< [s]
constexpr double line_period = 10.0;     ///< [s]
constexpr int bar_width = 24;

std::string clock_text(double seconds) {
    const auto s = static_cast<long long>(seconds);
    return s >= 3600 ? fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60)
                     : fmt::format("{}:{:02}", s / 60, s % 60);
}

}  // namespace

Progress::Progress(std::string label, bool terminal)
    : label_(std::move(label)),
      terminal_(terminal),
      started_(wall_clock()),
      next_(started_ + (terminal ? 0.0 : line_period)) {}

void Progress::update(const TimeLoop& run) {
    if (fraction_at_start_ < 0.0) fraction_at_start_ = run.loading_done();
    const double now = wall_clock();
    if (now < next_) return;
    next_ = now + (terminal_ ? terminal_period : line_period);
    show(run, now);
}

void Progress::show(const TimeLoop& run, double now) {
    const RunState& state = run.state();
    const double done = run.loading_done();
    const double stress = 0.5 * wall_stress(state.mean_force, state.box).sum();
    const double gained = done - fraction_at_start_;
    const std::string left = gained > 0.01 ? clock_text((now - started_) * (1.0 - done) / gained) : "--";
    const auto filled = static_cast<std::size_t>(std::clamp(done, 0.0, 1.0) * bar_width);
    const std::string numbers = fmt::format("{:5.1f} %  phi {:.4f}  stress {:.3e}  step {}  left {}",
                                            100.0 * done, state.packing_fraction, stress, state.step, left);
    if (terminal_) {
        fmt::print(stderr, "\r{:<10} [{}{}] {}\033[K", label_, std::string(filled, '#'),
                   std::string(bar_width - filled, '.'), numbers);
    } else {
        fmt::print(stderr, "{} {}\n", label_, numbers);
    }
    std::fflush(stderr);
}

void Progress::finish(const TimeLoop& run) {
    if (fraction_at_start_ < 0.0) fraction_at_start_ = 0.0;
    show(run, wall_clock());
    if (terminal_) fmt::print(stderr, "\n");
}

}  // namespace softgrain
