#pragma once
// Leap-frog of the grains of one block (DEM course, "Explicit FD scheme").
#include "rigid_dem/grain_record.hpp"

namespace softgrain::rigid_dem {

/// Flow that a periodic cell imposes: velocity at x is (x - origin) by the gradient, plus that of the origin.
struct Flow {
    double origin_x = 0.0, origin_y = 0.0, origin_vx = 0.0, origin_vy = 0.0;  ///< [m], [m/s]
    double xx = 0.0, xy = 0.0, yy = 0.0;  ///< dv_x/dx, dv_x/dy, dv_y/dy [1/s]
};

/// By lane, so that sums do not depend on the vectors' length.
struct MotionSums {
    using Lane = double[lanes];
    alignas(64) Lane xx, xy, yy;  ///< sum of m c (x) c, c against the flow [J]
    alignas(64) Lane work;        ///< taken out by non-viscous damping in this step [J]
    alignas(
        64) Lane speed2;  ///< largest squared speed against the flow; not a number if one is not [m^2/s^2]
};

struct MotionBlock {
    GrainRecord* grain;
    const ForceSum* force;
    int grains;
    double nonviscous_damping;  ///< lambda_d of Cundall
    bool rotates;
    bool flows;  ///< a periodic cell; without it the flow is not looked at
};

/// Velocities by the forces during `kick`, from the middle of the last step to that of this one, then
/// positions by the velocities during dt. Non-viscous damping takes the share lambda_d
/// of each force component that works, and adds it to one that is worked against (DEM course, "Damping").
void kick_and_drift(const MotionBlock& block, double kick, double dt, const Flow& flow, MotionSums& sums);

/// Adds the kinetic tensor against the flow, of velocities `ahead` of those kept by the present forces.
void add_kinetic_tensor(const GrainRecord* grain, const ForceSum* force, int grains, double ahead,
                        const Flow& flow, MotionSums& sums);

/// Largest squared distance, beyond what the flow did, from where the grains were [m^2].
/// x = F X + shift; X by grain, x and y in turn.
struct Deformation {
    double xx = 1.0, xy = 0.0, yy = 1.0, shift_x = 0.0, shift_y = 0.0;
};
double largest_displacement2(const GrainRecord* grain, const double* before, int grains,
                             const Deformation& by);

}  // namespace softgrain::rigid_dem
