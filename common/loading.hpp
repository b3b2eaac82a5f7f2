#pragma once
// From a loading stage to wall velocities. Outside the solvers, so that it is the same for every method.
#include <optional>

#include "common/scenario.hpp"

namespace softgrain {

/// One stage in progress. `progress` is the strain since the stage began, or the time of a hold [s].
class StageDriver {
  public:
    /// `initial` is the box at the start of the run, `begin` at the start of the stage.
    StageDriver(const LoadingStage& stage, const Sampling& sampling, const Box& initial, const Box& begin,
                double undeformed_area);

    bool is_hold() const { return stage_.kind == LoadingKind::hold; }
    /// 0 (x) or 1 (y).
    int axis() const;
    /// Engineering strain 1 - L/L0 of the whole run along the loading axis.
    double axial_strain(const Box& box) const;
    double progress(const Box& box, double stage_time) const;
    /// Progress at which the stage ends for certain; none if only the grains' answer can end it.
    std::optional<double> end() const { return end_; }
    double sample_interval() const { return interval_; }

    /// d(progress)/dt [1/s]; `pressure` is the present mean wall stress, `scale` the material's stress scale.
    double rate(double pressure, double scale, double mean_diameter, double density) const;
    /// Wall velocities for a strain rate (opposite walls move alike in an isotropic stage) [m/s].
    WallMotion motion(const Box& box, double rate) const;

    /// True if the grains' answer (packing fraction or stress) ends the stage.
    bool reached(double packing_fraction, double mean_stress) const;

  private:
    LoadingStage stage_;
    Box initial_, begin_;
    double interval_;
    std::optional<double> end_;
};

}  // namespace softgrain
