#include "common/thread_choice.hpp"

#include <algorithm>

namespace softgrain {

void ThreadChoice::note(double seconds) {
    if (decided_) return;
    spent_ += seconds;
    ++rounds_;
    const bool hopeless = parallel_ && spent_ > 2.0 * alone_ * (rounds_ + first_look);
    if (rounds_ < (alone_ < 0.0 ? first_look : window) && !hopeless) return;
    const double spent = spent_ / rounds_;
    rounds_ = 0;
    spent_ = 0.0;
    ++windows_;
    if (!parallel_) {
        alone_ = spent;
        if (windows_ < wait_) return;
        parallel_ = true;
        windows_ = 0;
    } else if (hopeless || spent >= alone_) {
        stop_threads(pause_);
        pause_ = std::min(2 * pause_, longest_pause);
    } else {
        pause_ = first_pause;
        if (windows_ >= longest_trust) stop_threads(1);
    }
}

void ThreadChoice::stop_threads(int pause) {
    parallel_ = false;
    windows_ = 0;
    wait_ = pause;
}

}  // namespace softgrain
