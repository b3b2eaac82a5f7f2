#include "sdem/pressure_block.hpp"

#include "common/simd.hpp"

namespace softgrain::sdem {
namespace {

struct SumLanes {
    using Lane = double[grains_per_block];
    alignas(64) Lane base{}, q0{}, q1{}, q1_squared{}, local{};
    // sum h dG/dh, by the factors of its parts.
    alignas(64) Lane base_slope{}, q0_slope{}, q1_slope{}, q1_squared_slope{};
};

/// One contact of each grain into its sums.
SOFTGRAIN_INLINE void add_row(const PressureBlock& b, OverlapRow& row, SumLanes& sum) {
#pragma omp simd
    for (int l = 0; l < b.count; ++l) {
        const LensPotential::Overlap o = LensPotential::overlap(row.overlap[l] * b.per_area[l]);
        row.r[l] = o.r;
        row.q1[l] = o.q1;
        row.base_slope[l] = o.base_slope;
        row.q0_slope[l] = o.q0_slope;
        row.q1_slope[l] = o.q1_slope;
        sum.base[l] += o.base;
        sum.q0[l] += o.q0;
        sum.q1[l] += o.q1;
        sum.q1_squared[l] += o.q1 * o.q1;
        sum.local[l] += o.h * o.r;
        const double h_q1_slope = o.h * o.q1_slope;
        sum.base_slope[l] += o.h * o.base_slope;
        sum.q0_slope[l] += o.h * o.q0_slope;
        sum.q1_slope[l] += h_q1_slope;
        sum.q1_squared_slope[l] += o.q1 * h_q1_slope;
    }
}

template <GrainLaw law>
SOFTGRAIN_INLINE void press(PressureBlock& b) {
#pragma omp simd
    for (int l = 0; l < b.count; ++l) b.per_area[l] = 1.0 / (b.area[l] * b.det[l]);
    SumLanes sum;
    for (int k = 0; k < b.rows; ++k) add_row(b, b.row[k], sum);
#pragma omp simd
    for (int l = 0; l < b.count; ++l) {
        const LensPotential::Sums s{sum.base[l], sum.q0[l], sum.q1[l], sum.q1_squared[l], sum.local[l]};
        const LensPotential::Inflation in = LensPotential::inflation(s, b.bulge[l]);
        const double area_ratio = b.det[l] * (1.0 - in.G);
        double p;
        if constexpr (law == GrainLaw::neo_hookean)
            p = LensPotential::pressure(area_ratio, b.mu[l], b.kappa[l]);
        else
            p = -b.kappa[l] * (area_ratio - 1.0);
        const double h_slope = in.slope(sum.base_slope[l], sum.q0_slope[l], 0.0, sum.q1_slope[l]) +
                               in.at_q1_squared * sum.q1_squared_slope[l];
        b.area_ratio[l] = area_ratio;
        b.stress[l] = p * ((1.0 - in.G) + h_slope) + (1.0 / 3.0) * b.plane_E[l] * sum.local[l];
        b.pressure[l] = p;
        b.at_q0[l] = in.at_q0;
        b.at_q1[l] = in.at_q1;
        b.at_q1_squared[l] = in.at_q1_squared;
    }
    for (int k = 0; k < b.rows; ++k) {
        OverlapRow& row = b.row[k];
#pragma omp simd
        for (int l = 0; l < b.count; ++l) {
            const LensPotential::Inflation in{0.0, b.at_q0[l], b.at_q1[l], b.at_q1_squared[l]};
            const double slope = in.slope(row.base_slope[l], row.q0_slope[l], row.q1[l], row.q1_slope[l]);
            row.answer[l] = row.share[l] * (b.pressure[l] * slope + b.plane_E[l] * row.r[l]);
        }
    }
}

SOFTGRAIN_CLONES void press_neo_hookean(PressureBlock& block) {
    press<GrainLaw::neo_hookean>(block);
}
SOFTGRAIN_CLONES void press_linear(PressureBlock& block) {
    press<GrainLaw::linear>(block);
}

SOFTGRAIN_CLONES void resist(PressureBlock& b) {
    for (int k = 0; k < b.rows; ++k) {
        OverlapRow& row = b.row[k];
#pragma omp simd
        for (int l = 0; l < b.count; ++l) {
            const Inflated grain{b.pressure[l], b.per_area[l], b.at_q0[l], b.at_q1[l], b.at_q1_squared[l]};
            row.answer[l] = resistance(grain, row.overlap[l], row.share[l], b.area[l], b.plane_E[l],
                                       LensPotential::bulk_stiffness(b.mu[l], b.kappa[l]));
        }
    }
}

}  // namespace

void find_resistances(PressureBlock& block) {
    resist(block);
}

void find_pressures(PressureBlock& block, GrainLaw law) {
    law == GrainLaw::neo_hookean ? press_neo_hookean(block) : press_linear(block);
}

}  // namespace softgrain::sdem
