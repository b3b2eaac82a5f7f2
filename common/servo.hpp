#pragma once
// Servo-control: brings the stress on the walls, or of a periodic cell, to what a stage asks. Outside the
// solvers and without knowledge of them, so that it is the same for every method.
#include <array>
#include <optional>

#include "common/box.hpp"
#include "common/checkpoint.hpp"
#include "common/stage_plan.hpp"

namespace softgrain {

/// What the servo remembers from step to step, by axis (0: x, 1: y). Part of the state of a run.
struct ServoState {
    std::array<double, 2> stress{};       ///< on the boundary, smoothed [N/m]
    std::array<double, 2> strain{};       ///< 1 - L/L0, smoothed in the same way
    std::array<double, 2> rate{};         ///< of strain, in the next step [1/s]
    std::array<double, 2> offset{};       ///< part of `rate` that holds against a steady disturbance [1/s]
    std::array<double, 2> begin{};        ///< stress at the start of the stage [N/m]
    std::array<double, 2> arrived{};      ///< 1 once the stress has been near its target, else 0
    double way = 0.0;                     ///< of the set point from `begin` to the targets, 0 to 1
    double stiffness = 0.0;               ///< d stress / d strain of the packing, 0: not known yet [N/m]
    std::array<double, 2> seen_stress{};  ///< where the stiffness was last looked at [N/m]
    std::array<double, 2> seen_strain{};
    double since_seen = 0.0;  ///< [s]

    void save(Checkpoint& to) const;
    void load(const Checkpoint& from);
};

class Servo {
  public:
    /// `initial` is the box at the start of the run; `density` [kg/m^2] and `diameter` [m] are means of the
    /// grains. Only if `learns` is the stiffness measured: not while something else strains the packing.
    Servo(const StressTargets& targets, const Box& initial, double density, double diameter, bool learns);

    /// The state at the start of a stage, from that of the stage before and the present stress of each axis.
    /// `stress_scale` stands for the stiffness until that is known.
    ServoState begin(const ServoState& before, const Box& box, const std::array<double, 2>& stress,
                     double stress_scale) const;

    /// After a step of `dt`: takes in the stress of each axis and sets the rates of the next step, at most
    /// `limit` [1/s].
    void update(ServoState& state, const Box& box, const std::array<double, 2>& stress, double limit,
                double dt) const;

    const StressTargets& targets() const { return targets_; }

  private:
    double strain(const Box& box, int axis) const;
    double response_time(const ServoState& state, const Box& box) const;
    void learn(ServoState& state, const Box& box, double dt) const;
    double longest_way(const ServoState& state) const;
    void move_set_point(ServoState& state, double limit, double time_constant, double dt) const;

    StressTargets targets_;
    Box initial_;
    double density_, diameter_;
    bool learns_;
};

}  // namespace softgrain
