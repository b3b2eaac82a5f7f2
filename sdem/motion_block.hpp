#pragma once
// Up to 64 grains side by side, structure of arrays, on their way through one step.
#include "sdem/motion_law.hpp"
#include "sdem/tensor.hpp"

namespace softgrain::sdem {

struct TensorLanes {
    alignas(64) double xx[grains_per_block], xy[grains_per_block], yx[grains_per_block], yy[grains_per_block];

    SOFTGRAIN_INLINE Tensor operator[](int l) const { return {xx[l], xy[l], yx[l], yy[l]}; }
    SOFTGRAIN_INLINE void set(int l, const Tensor& t) {
        xx[l] = t.xx;
        xy[l] = t.xy;
        yx[l] = t.yx;
        yy[l] = t.yy;
    }
};

struct MotionBlock {
    using Lane = double[grains_per_block];
    int count;
    // State before the kick, and what the material says.
    alignas(64) Lane x, y, vx, vy, a, b, mass, inertia_x, inertia_y, area;
    TensorLanes F, F_rate;
    alignas(64) Lane mu, kappa, damping_rate, dilation_inertia, yield;
    // Forces.
    alignas(64) Lane flow_vx, flow_vy;  // velocity of the cell's flow, zero without one
    Tensor flux;                        // sum m u (x) u of the velocities u against it
    alignas(64) Lane fx, fy, damping_fx, damping_fy, caps, pressure;
    TensorLanes moment, damping_moment;  // conjugate to F: in units of M F''
    // Plastic state.
    alignas(64) Lane plastic_xx, plastic_xy, plastic_yy, plastic_work;
    // After the kick.
    alignas(64) Lane new_vx, new_vy, stored, damped, kinetic;
    TensorLanes new_rate;
    // After the drift.
    alignas(64) Lane reach, moved, det, caps_before;
};

/// One step in time [s].
struct StepTimes {
    double last_drift, kick, next_drift;
};

/// Adds inner stress and shape damping to the moments; plastic grains flow.
void add_inner_stress(MotionBlock& block, const MotionLaw& law);
/// Velocities and rates after the kick, what the kinematics allow of them, and the work done.
void kick(MotionBlock& block, const MotionLaw& law, const StepTimes& times);
/// Positions and shapes after dt, put back on what the kinematics allow.
void drift(MotionBlock& block, const MotionLaw& law, double dt);

}  // namespace softgrain::sdem
