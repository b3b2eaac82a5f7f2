#pragma once
// How far a run is: one bar on a terminal, plain lines elsewhere. Written to standard error.
#include <string>

#include "common/time_loop.hpp"

namespace softgrain {

class Progress {
  public:
    Progress(std::string label, bool terminal);
    /// Cheap to call after every step; shows something only when enough time has passed.
    void update(const TimeLoop& run);
    void finish(const TimeLoop& run);

  private:
    void show(const TimeLoop& run, double now);

    std::string label_;
    bool terminal_;
    double started_, next_;
    double fraction_at_start_ = -1.0;
};

}  // namespace softgrain
