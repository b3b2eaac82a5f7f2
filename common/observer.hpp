#pragma once
// A reader of the grains at each sample: writers of history, VTK files, progress.
#include <span>
#include <string>
#include <vector>

#include "common/grain_view.hpp"

namespace softgrain {

/// One sampling moment of the run.
struct Sample {
    int index = 0;          ///< 0 at the start of the run
    bool is_frame = false;  ///< this sample is also a frame (a VTK time step)
    int frame = 0;          ///< number of frames before this sample
    long long step = 0;
    double loading = 0.0;         ///< fraction of the whole loading done, 0 to 1 (estimate)
    std::span<const double> row;  ///< the history row, in the order of the table of observables
};

class Observer {
  public:
    virtual ~Observer() = default;
    /// What `observe` reads at this sample.
    virtual Need need(const Sample& sample) const = 0;
    /// Throws OutputError.
    virtual void observe(const GrainView& view, const Sample& sample) = 0;
    /// Called instead of a fresh start when a run goes on: frames written so far, at these times [s]. Returns
    /// lines about files of them that are lost (LostFiles). Throws OutputError, and InputError if a file is
    /// lost that what follows depends on.
    virtual std::vector<std::string> resume(std::span<const double> frame_times) {
        (void)frame_times;
        return {};
    }
};

}  // namespace softgrain
