#pragma once
// From a loading stage to the motion of the walls or the cell. Outside the solvers, so that it is the same
// for every method.
#include <optional>

#include "common/scenario.hpp"

namespace softgrain {

/// One stage in progress. `progress` is the strain since the stage began, positive in its own direction, or
/// the time of a hold or gradient [s].
class StageDriver {
  public:
    /// `initial` is the box at the start of the run, `begin` at the start of the stage. Throws InputError if
    /// the stage would have to go back to reach its until_strain or until_shear; `number` is its place in
    /// the scenario, for the message.
    StageDriver(const LoadingStage& stage, int number, const Sampling& sampling, const Box& initial,
                const Box& begin, double undeformed_area);

    /// 0 (x) or 1 (y).
    int axis() const;
    /// Engineering strain 1 - L/L0 of the whole run along the loading axis.
    double axial_strain(const Box& box) const;
    double progress(const Box& box, double stage_time) const;
    /// Progress at which the stage ends for certain; none if only the grains' answer can end it.
    std::optional<double> end() const { return end_; }
    double sample_interval() const { return interval_; }

    /// d(progress)/dt [1/s]; `pressure` is the present mean stress, `scale` the material's stress scale.
    double rate(double pressure, double scale, double mean_diameter, double density) const;
    /// Strain rate of the grains for d(progress)/dt [1/s]: 0 of a hold.
    double strain_rate(double rate) const;
    /// Motion for a strain rate during a step dt (opposite walls move alike in an isotropic stage).
    WallMotion motion(const Box& box, double rate, double dt) const;

    /// True if the grains' answer (packing fraction or stress) ends the stage.
    bool reached(double packing_fraction, double mean_stress) const;

  private:
    /// By time and not by strain.
    bool is_timed() const { return stage_.kind == LoadingKind::hold || stage_.kind == LoadingKind::gradient; }
    /// +1, or -1 in reverse.
    double direction() const { return stage_.reverse ? -1.0 : 1.0; }
    /// The strain that the stage drives: axial or shear.
    double strain(const Box& box) const;
    /// Signed strain from here to the undeformed packing fraction asked.
    double strain_to_undeformed(double undeformed_area) const;
    WallMotion gradient_motion(const Box& box, double dt) const;

    LoadingStage stage_;
    Box initial_, begin_;
    double interval_;
    std::optional<double> end_;
};

}  // namespace softgrain
