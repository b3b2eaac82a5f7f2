#include "rigid_dem/motion_kernel.hpp"

#include <cmath>

#include "common/simd.hpp"

namespace softgrain::rigid_dem {
namespace {

/// Force less the damped share of it, and the work that this takes out of the grain.
SOFTGRAIN_INLINE double damped(double force, double velocity, double share, double kick, double per_mass,
                               double& work) {
    const double taken = share * (force * velocity > 0.0 ? force : force * velocity < 0.0 ? -force : 0.0);
    const double left = force - taken;
    work += taken * (velocity + 0.5 * kick * left * per_mass) * kick;
    return left;
}

template <bool rotates, bool nonviscous, bool flows>
SOFTGRAIN_INLINE void move(const MotionBlock& block, double kick, double dt, const Flow& flow,
                           MotionSums& sums) {
    for (int first = 0; first < block.grains; first += lanes) {
        GrainRecord* const grain = block.grain + first;
        const ForceSum* const force = block.force + first;
        const int count = block.grains - first < lanes ? block.grains - first : lanes;
#pragma omp simd
        for (int l = 0; l < count; ++l) {
            GrainRecord& g = grain[l];
            double fx = force[l].fx, fy = force[l].fy, work = 0.0;
            double flow_vx = 0.0, flow_vy = 0.0;
            if constexpr (flows) {
                const double dx = g.x - flow.origin_x, dy = g.y - flow.origin_y;
                flow_vx = flow.origin_vx + flow.xx * dx + flow.xy * dy;
                flow_vy = flow.origin_vy + flow.yy * dy;
            }
            if constexpr (nonviscous) {
                fx = damped(fx, g.vx - flow_vx, block.nonviscous_damping, kick, g.inverse_mass, work);
                fy = damped(fy, g.vy - flow_vy, block.nonviscous_damping, kick, g.inverse_mass, work);
            }
            const double vx = g.vx + fx * (kick * g.inverse_mass), vy = g.vy + fy * (kick * g.inverse_mass);
            if constexpr (rotates) {  // of a disc: I = m R^2 / 2
                const double per_inertia = 2.0 * g.inverse_mass / (g.radius * g.radius);
                double torque = g.radius * force[l].shear - force[l].lost_torque;
                if constexpr (nonviscous)
                    torque = damped(torque, g.spin, block.nonviscous_damping, kick, per_inertia, work);
                g.spin += kick * per_inertia * torque;
                g.rim_speed = g.spin * g.radius;
            }
            g.vx = vx;
            g.vy = vy;
            g.x += vx * dt;
            g.y += vy * dt;
            const double cx = vx - flow_vx, cy = vy - flow_vy, speed2 = cx * cx + cy * cy;
            const double so_far = sums.speed2[l];  // once not a number, always
            sums.speed2[l] = (speed2 <= so_far) | (so_far != so_far) ? so_far : speed2;
            if constexpr (nonviscous) sums.work[l] += work;
        }
    }
}

SOFTGRAIN_CLONES void move_only(const MotionBlock& block, double kick, double dt, const Flow& flow,
                                MotionSums& sums) {
    move<false, false, false>(block, kick, dt, flow, sums);
}
SOFTGRAIN_CLONES void move_and_turn(const MotionBlock& block, double kick, double dt, const Flow& flow,
                                    MotionSums& sums) {
    move<true, false, false>(block, kick, dt, flow, sums);
}
SOFTGRAIN_CLONES void move_damped(const MotionBlock& block, double kick, double dt, const Flow& flow,
                                  MotionSums& sums) {
    move<false, true, false>(block, kick, dt, flow, sums);
}
SOFTGRAIN_CLONES void move_and_turn_damped(const MotionBlock& block, double kick, double dt, const Flow& flow,
                                           MotionSums& sums) {
    move<true, true, false>(block, kick, dt, flow, sums);
}
SOFTGRAIN_CLONES void move_in_flow(const MotionBlock& block, double kick, double dt, const Flow& flow,
                                   MotionSums& sums) {
    move<false, true, true>(block, kick, dt, flow, sums);
}
SOFTGRAIN_CLONES void move_and_turn_in_flow(const MotionBlock& block, double kick, double dt,
                                            const Flow& flow, MotionSums& sums) {
    move<true, true, true>(block, kick, dt, flow, sums);
}

SOFTGRAIN_CLONES double displacement2(const GrainRecord* grain, const double* before, int grains,
                                      const Deformation& by) {
    alignas(64) double largest[lanes]{};
    for (int first = 0; first < grains; first += lanes) {
        const int count = grains - first < lanes ? grains - first : lanes;
#pragma omp simd
        for (int l = 0; l < count; ++l) {
            const double x = before[2 * (first + l)], y = before[2 * (first + l) + 1];
            const double dx = grain[first + l].x - (by.shift_x + by.xx * x + by.xy * y);
            const double dy = grain[first + l].y - (by.shift_y + by.yy * y);
            const double d2 = dx * dx + dy * dy;
            largest[l] = d2 > largest[l] ? d2 : largest[l];
        }
    }
    double most = 0.0;
    for (const double d2 : largest) most = d2 > most ? d2 : most;
    return most;
}

SOFTGRAIN_CLONES void kinetic_tensor(const GrainRecord* grain, const ForceSum* force, int grains,
                                     double ahead, const Flow& flow, MotionSums& sums) {
    for (int first = 0; first < grains; first += lanes) {
        const int count = grains - first < lanes ? grains - first : lanes;
#pragma omp simd
        for (int l = 0; l < count; ++l) {
            const GrainRecord& g = grain[first + l];
            const double dx = g.x - flow.origin_x, dy = g.y - flow.origin_y;
            const double kick = ahead * g.inverse_mass, mass = 1.0 / g.inverse_mass;
            const ForceSum& f = force[first + l];
            const double cx = g.vx + f.fx * kick - (flow.origin_vx + flow.xx * dx + flow.xy * dy);
            const double cy = g.vy + f.fy * kick - (flow.origin_vy + flow.yy * dy);
            sums.xx[l] += mass * cx * cx;
            sums.xy[l] += mass * cx * cy;
            sums.yy[l] += mass * cy * cy;
        }
    }
}

}  // namespace

void kick_and_drift(const MotionBlock& block, double kick, double dt, const Flow& flow, MotionSums& sums) {
    const bool nonviscous = block.nonviscous_damping > 0.0;
    if (block.flows)
        (block.rotates ? move_and_turn_in_flow : move_in_flow)(block, kick, dt, flow, sums);
    else if (block.rotates)
        (nonviscous ? move_and_turn_damped : move_and_turn)(block, kick, dt, flow, sums);
    else
        (nonviscous ? move_damped : move_only)(block, kick, dt, flow, sums);
}

void add_kinetic_tensor(const GrainRecord* grain, const ForceSum* force, int grains, double ahead,
                        const Flow& flow, MotionSums& sums) {
    kinetic_tensor(grain, force, grains, ahead, flow, sums);
}

double largest_displacement2(const GrainRecord* grain, const double* before, int grains,
                             const Deformation& by) {
    return displacement2(grain, before, grains, by);
}

}  // namespace softgrain::rigid_dem
