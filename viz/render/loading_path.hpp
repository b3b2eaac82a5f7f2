#pragma once
// Runs side by side at the same loading, whatever frames each of them has written.
#include <string>
#include <vector>

#include "viz/render/run_reader.hpp"

namespace softgrain {

/// A measure of how far each run has been loaded, which grows from frame to frame in all of them: the packing
/// fraction, else the path of strain, else the time.
class LoadingPath {
  public:
    /// The runs must outlive it. `by_packing_fraction`: that one, growing or not; throws InputError if a run
    /// does not have it.
    LoadingPath(const std::vector<RunReader>& runs, bool by_packing_fraction);

    const std::string& quantity() const { return quantity_; }
    double start() const { return start_; }  ///< of the run that starts first
    double end() const { return end_; }      ///< of the run that goes farthest
    double last_common() const;              ///< where the first of them ends
    /// At the frames of the run that has most, and then of the one that goes farthest.
    std::vector<double> all_stages() const;

    struct Match {
        std::size_t frame;
        bool beyond_end;  ///< the stage lies behind the run's last frame
    };
    /// The frame of a run that is nearest to a stage.
    Match match(std::size_t run, double stage) const;

  private:
    double spacing(std::size_t run) const;

    std::string quantity_;
    std::vector<std::vector<double>> at_frames_;  ///< [runs][frames]
    double start_ = 0.0, end_ = 0.0;
};

}  // namespace softgrain
