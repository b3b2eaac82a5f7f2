#pragma once
// The lens potential of up to 64 grains side by side: what each does to all its contacts. Free of Eigen.
#include "sdem/motion_law.hpp"

namespace softgrain::sdem {

/// One contact of each of 64 grains; overlap 0 and `to` anywhere harmless if a grain has no more.
struct OverlapRow {
    using Lane = double[grains_per_block];
    alignas(64) Lane overlap;                                ///< beta S [m^2]
    alignas(64) Lane share;                                  ///< beta
    alignas(64) double* to[grains_per_block];                ///< where the answer goes
    alignas(64) Lane r, q1, base_slope, q0_slope, q1_slope;  ///< between two loops
    alignas(64) Lane push;                                   ///< beta dU/d(beta S) [N/m]
};

/// What a grain's pressure does to its contacts, for the time step.
struct Inflated {
    double pressure;                     ///< p [N/m]
    double per_area;                     ///< 1/(A0 J) [1/m^2]
    double at_q0, at_q1, at_q1_squared;  ///< see LensPotential::Inflation
};

struct PressureBlock {
    using Lane = double[grains_per_block];
    int count, rows;
    OverlapRow* row;  ///< [rows]
    alignas(64) Lane det, area, mu, kappa, plane_E, bulge;
    alignas(64) Lane area_ratio;  ///< Je
    alignas(64) Lane stress;      ///< P: -dU/dJ at fixed overlaps, without the shear part [N/m]
    alignas(64) Lane pressure, per_area, at_q0, at_q1, at_q1_squared;
};

/// From overlaps to answers.
void find_pressures(PressureBlock& block, GrainLaw law);

}  // namespace softgrain::sdem
