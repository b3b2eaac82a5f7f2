#pragma once
// The lens potential of up to 64 grains side by side: what each does to all its contacts. Free of Eigen.
#include "sdem/laws/lens_potential.hpp"
#include "sdem/motion_law.hpp"

namespace softgrain::sdem {

/// One contact of each of 64 grains; overlap 0 and `to` anywhere harmless if a grain has no more.
struct OverlapRow {
    using Lane = double[grains_per_block];
    alignas(64) Lane overlap;                                ///< beta S [m^2]
    alignas(64) double* to[grains_per_block];                ///< where the answer goes
    alignas(64) Lane r, q1, base_slope, q0_slope, q1_slope;  ///< between two loops
    alignas(64) Lane answer;
};

/// What a grain's pressure makes of its contacts.
struct Inflated {
    double pressure, per_area;           ///< p [N/m], 1/(A0 J) [1/m^2]
    double at_q0, at_q1, at_q1_squared;  ///< see LensPotential::Inflation
};

/// Derivative of a side's push by its overlap, an estimate up to 20 % low [N/m^3]; overlap: beta S > 0 [m^2],
/// bulk: of u''.
SOFTGRAIN_INLINE double resistance(const Inflated& grain, double overlap, double area, double plane_E,
                                   double bulk) {
    const LensPotential::Overlap o = LensPotential::overlap(overlap * grain.per_area);
    const LensPotential::Inflation in{0.0, grain.at_q0, grain.at_q1, grain.at_q1_squared};
    const double slope = in.slope(o), bending = std::abs(grain.pressure * LensPotential::curvature(o, in));
    return bulk * slope * slope / area + grain.per_area * (0.5 * plane_E / o.r + bending);
}

struct PressureBlock {
    using Lane = double[grains_per_block];
    static constexpr int group = 8;  ///< lanes that share their number of rows
    static constexpr int groups = static_cast<int>(grains_per_block) / group;
    int count, rows[groups];
    OverlapRow* row;  ///< [largest of rows]
    alignas(64) Lane det, area, mu, kappa, plane_E, bulge;
    alignas(64) Lane area_ratio;  ///< Je
    alignas(64) Lane stress;      ///< P: -dU/dJ at fixed overlaps, without the shear part [N/m]
    alignas(64) Lane pressure, per_area, at_q0, at_q1, at_q1_squared;
};

/// From overlaps to pressures; the answers are dU/d(beta S), the push of each side [N/m].
void find_pressures(PressureBlock& block, GrainLaw law);
/// From overlaps and what pressure made of them; the answers are resistances.
void find_resistances(PressureBlock& block);

}  // namespace softgrain::sdem
