#pragma once
// From a loading stage to the motion of the walls or the cell. Outside the solvers, so that it is the same
// for every method.
#include <optional>

#include "common/scenario.hpp"
#include "common/servo.hpp"
#include "common/stage_plan.hpp"

namespace softgrain {

/// What a stage needs to know of the grains.
struct Grains {
    double undeformed_area = 0.0;  ///< of all [m^2]
    double mean_diameter = 0.0;    ///< of the disc of mean area [m]
    double density = 0.0;          ///< mean [kg/m^2]
    double stress_scale = 0.0;     ///< Solver::stress_scale [N/m]
};

/// Where the run stood when the stage began.
struct StageBegin {
    Box box;
    std::array<double, 2> stress{};  ///< of each axis [N/m]
};

/// How the grains have answered, at a check of the loop.
struct Answer {
    double packing_fraction = 0.0;
    Mat2 stress = Mat2::Zero();  ///< mean since the mean began, of the walls or the cell [N/m]
    double unbalanced = 0.0;     ///< unbalanced_force(); only if StageDriver::wants_unbalanced()
};

/// One stage in progress. `progress` is counted since the stage began, positive in its own direction, in what
/// its plan says.
class StageDriver {
  public:
    /// `initial` is the box at the start of the run. Throws InputError if the stage would have to go back to
    /// reach its until_strain or until_shear, or goes to a stress that pulls; `number` is its place in the
    /// scenario, for the message.
    StageDriver(const LoadingStage& stage, std::size_t number, const Sampling& sampling, const Box& initial,
                const StageBegin& begin, const Grains& grains);

    /// Engineering strain 1 - L/L0 of the whole run along the loading axis.
    double axial_strain(const Box& box) const;
    /// `most_strain` is the integral of rate() over the time of the stage.
    double progress(const Box& box, double stage_time, double most_strain) const;
    /// Progress at which the stage ends for certain; none if only the grains' answer or time can end it.
    std::optional<double> end() const { return end_; }
    /// Time of the stage at which it ends, beside its progress [s].
    std::optional<double> end_time() const;
    double sample_interval() const { return interval_; }

    /// d(progress)/dt [1/s], the largest strain rate of the servo too; `pressure` is the present mean stress.
    /// I is that at this pressure, but at least at 1e-3 of the stress scale, or at the stress asked for.
    double rate(double pressure) const;
    /// Largest strain rate of a servo-controlled axis for it [1/s].
    double servo_limit(double rate) const;
    /// Strain rate of the grains for d(progress)/dt [1/s]: 0 of a hold.
    double strain_rate(double rate, const ServoState& servo) const;
    /// Motion for a rate during a step dt (opposite walls move alike, but for a single wall).
    WallMotion motion(const Box& box, double rate, const ServoState& servo, double dt) const;

    /// None if no axis is servo-controlled.
    const std::optional<Servo>& servo() const { return servo_; }
    bool wants_unbalanced() const { return stage_.until_unbalanced || stage_.seeks_stress(); }
    /// True if the grains' answer ends the stage.
    bool reached(const Answer& answer, const Box& box, const ServoState& servo) const;

  private:
    /// By time and not by strain.
    bool is_timed() const { return plan_.progress == ProgressMeasure::time; }
    /// +1, or -1 in reverse.
    double direction() const { return stage_.reverse ? -1.0 : 1.0; }
    void find_end();
    /// The strain that the stage drives: axial, shear or along the path of a probe.
    double strain(const Box& box) const;
    /// Signed strain from here to the undeformed packing fraction asked.
    double strain_to_undeformed() const;
    WallMotion gradient_motion(const Box& box, double dt) const;
    double tilt_rate(const WallMotion& motion, double rate, double dt) const;
    bool at_stress(const Answer& answer, const ServoState& servo) const;

    LoadingStage stage_;
    std::size_t number_;
    Box initial_, begin_;
    Grains grains_;
    StagePlan plan_;
    std::optional<Servo> servo_;
    double interval_ = 0.0;
    std::optional<double> end_;
};

}  // namespace softgrain
