#pragma once
// What contacts read of a grain and what they leave with it, in a form that fills vectors.
#include <cstdint>

namespace softgrain::rigid_dem {

/// One cache line. Velocities are half a step behind the position (leap-frog).
struct alignas(64) GrainRecord {
    double x = 0.0, y = 0.0, vx = 0.0, vy = 0.0;  ///< [m], [m/s]
    double spin = 0.0;                            ///< [1/s]
    double radius = 0.0;                          ///< [m]
    double rim_speed = 0.0;                       ///< spin * radius [m/s]
    double inverse_mass = 0.0;                    ///< [1/kg]
};

/// Velocities of a grain, half a step behind its position.
struct GrainMotion {
    double vx, vy, spin;  ///< [m/s], [1/s]
};

/// Sum over the contacts of a grain.
struct alignas(32) ForceSum {
    double fx = 0.0, fy = 0.0;  ///< [N]
    double shear = 0.0;         ///< of the tangential forces [N]
    double lost_torque = 0.0;   ///< torque = radius * shear - lost_torque [N m]
};

/// Two grains of a block by their places in it.
struct LocalPair {
    std::uint16_t i, j;
};

/// Pairs are worked on in batches, a multiple of the longest vector.
inline constexpr int lanes = 64;

}  // namespace softgrain::rigid_dem
