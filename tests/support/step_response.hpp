#pragma once
// How a stress came to its target.
#include <algorithm>
#include <cmath>
#include <vector>

namespace softgrain::testing {

/// The stress of one axis while a servo takes it from `from` to `to`.
class StepResponse {
  public:
    StepResponse(double from, double to) : from_(from), to_(to) {}

    void add(double time, double stress) {
        time_.push_back(time);
        error_.push_back((stress - to_) / std::abs(to_ - from_));
    }
    /// Farthest beyond the target, as a share of the step; 0 if never.
    double overshoot() const {
        double most = 0.0;
        for (const double e : error_) most = std::max(most, to_ > from_ ? e : -e);
        return most;
    }
    /// From the first time to the last at which it was farther from the target than this share of the step.
    double settling_time(double band = 0.02) const {
        for (std::size_t k = error_.size(); k-- > 0;)
            if (std::abs(error_[k]) > band) return time_[k] - time_.front();
        return 0.0;
    }
    /// How often it went from one side of the target to the other, beyond this share of the step.
    int crossings(double band = 0.02) const {
        int count = 0, side = 0;
        for (const double e : error_) {
            const int now = e > band ? 1 : e < -band ? -1 : side;
            if (side != 0 && now != side) ++count;
            side = now;
        }
        return count;
    }
    double last_error() const { return error_.back(); }
    double time() const { return time_.back() - time_.front(); }

  private:
    double from_, to_;
    std::vector<double> time_, error_;
};

}  // namespace softgrain::testing
