#include "sdem/pressure_block.hpp"

#include "common/simd.hpp"

namespace softgrain::sdem {
namespace {

/// One group of lanes from `from` on: as many rows as its fullest grain has contacts.
template <GrainLaw law>
SOFTGRAIN_INLINE void press(PressureBlock& b, int from, int rows) {
    constexpr int group = PressureBlock::group;
    alignas(64) double base[group]{}, q0[group]{}, q1[group]{}, q1_squared[group]{}, local[group]{};
    alignas(64) double h_slope[group]{};  // sum h dG/dh
#pragma omp simd
    for (int m = 0; m < group; ++m) b.per_area[from + m] = 1.0 / (b.area[from + m] * b.det[from + m]);
    for (int k = 0; k < rows; ++k) {
        OverlapRow& row = b.row[k];
#pragma omp simd
        for (int m = 0; m < group; ++m) {
            const int l = from + m;
            const LensPotential::Overlap o = LensPotential::overlap(row.overlap[l] * b.per_area[l]);
            row.r[l] = o.r;
            row.q1[l] = o.q1;
            row.base_slope[l] = o.base_slope;
            row.q0_slope[l] = o.q0_slope;
            row.q1_slope[l] = o.q1_slope;
            base[m] += o.base;
            q0[m] += o.q0;
            q1[m] += o.q1;
            q1_squared[m] += o.q1 * o.q1;
            local[m] += o.h * o.r;
        }
    }
#pragma omp simd
    for (int m = 0; m < group; ++m) {
        const int l = from + m;
        const LensPotential::Sums s{base[m], q0[m], q1[m], q1_squared[m], local[m]};
        const LensPotential::Inflation in = LensPotential::inflation(s, b.bulge[l]);
        const double left = 1.0 - in.G, area_ratio = b.det[l] * left;
        double p;
        if constexpr (law == GrainLaw::neo_hookean)
            p = LensPotential::pressure(area_ratio, b.mu[l], b.kappa[l]);
        else
            p = -b.kappa[l] * (area_ratio - 1.0);
        b.area_ratio[l] = area_ratio;
        b.pressure[l] = p;
        b.at_q0[l] = in.at_q0;
        b.at_q1[l] = in.at_q1;
        b.at_q1_squared[l] = in.at_q1_squared;
        base[m] = left;
    }
    for (int k = 0; k < rows; ++k) {
        OverlapRow& row = b.row[k];
#pragma omp simd
        for (int m = 0; m < group; ++m) {
            const int l = from + m;
            const LensPotential::Inflation in{0.0, b.at_q0[l], b.at_q1[l], b.at_q1_squared[l]};
            const double slope = in.slope(row.base_slope[l], row.q0_slope[l], row.q1[l], row.q1_slope[l]);
            h_slope[m] += row.overlap[l] * b.per_area[l] * slope;
            row.answer[l] = b.pressure[l] * slope + b.plane_E[l] * row.r[l];
        }
    }
#pragma omp simd
    for (int m = 0; m < group; ++m) {
        const int l = from + m;
        b.stress[l] = b.pressure[l] * (base[m] + h_slope[m]) + (1.0 / 3.0) * b.plane_E[l] * local[m];
    }
}

template <GrainLaw law>
SOFTGRAIN_INLINE void press_all(PressureBlock& b) {
    constexpr int group = PressureBlock::group;
    for (int from = 0; from < b.count; from += group) press<law>(b, from, b.rows[from / group]);
}

SOFTGRAIN_CLONES void press_neo_hookean(PressureBlock& block) {
    press_all<GrainLaw::neo_hookean>(block);
}
SOFTGRAIN_CLONES void press_linear(PressureBlock& block) {
    press_all<GrainLaw::linear>(block);
}

SOFTGRAIN_CLONES void resist(PressureBlock& b) {
    int rows = 0;
    for (const int of_group : b.rows) rows = of_group > rows ? of_group : rows;
    for (int k = 0; k < rows; ++k) {
        OverlapRow& row = b.row[k];
#pragma omp simd
        for (int l = 0; l < b.count; ++l) {
            const Inflated grain{b.pressure[l], b.per_area[l], b.at_q0[l], b.at_q1[l], b.at_q1_squared[l]};
            row.answer[l] = resistance(grain, row.overlap[l], b.area[l], b.plane_E[l],
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
