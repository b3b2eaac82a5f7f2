#include "sdem/pressure_block.hpp"

#include "common/simd.hpp"

namespace softgrain::sdem {
namespace {

/// Sums over the contacts of each grain.
struct SumLanes {
    using Lane = double[grains_per_block];
    alignas(64) Lane base{}, q0{}, q1{}, q1_squared{}, local{};
    alignas(64) Lane h_slope{};  // sum h dG/dh
};

/// All overlaps, a group with as many rows as its fullest grain has contacts.
SOFTGRAIN_INLINE void add_overlaps(PressureBlock& b, SumLanes& sum) {
    for (int from = 0; from < b.count; from += PressureBlock::group)
        for (int k = 0; k < b.rows[from / PressureBlock::group]; ++k) {
            OverlapRow& row = b.row[k];
#pragma omp simd
            for (int l = from; l < from + PressureBlock::group; ++l) {
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
            }
        }
}

SOFTGRAIN_INLINE void answer_all(PressureBlock& b, SumLanes& sum) {
    for (int from = 0; from < b.count; from += PressureBlock::group)
        for (int k = 0; k < b.rows[from / PressureBlock::group]; ++k) {
            OverlapRow& row = b.row[k];
#pragma omp simd
            for (int l = from; l < from + PressureBlock::group; ++l) {
                const LensPotential::Inflation in{0.0, b.at_q0[l], b.at_q1[l], b.at_q1_squared[l]};
                const double slope = in.slope(row.base_slope[l], row.q0_slope[l], row.q1[l], row.q1_slope[l]);
                sum.h_slope[l] += row.overlap[l] * b.per_area[l] * slope;
                row.answer[l] = b.pressure[l] * slope + b.plane_E[l] * row.r[l];
            }
        }
}

template <GrainLaw law>
SOFTGRAIN_INLINE void press(PressureBlock& b) {
    SumLanes sum;
#pragma omp simd
    for (int l = 0; l < b.count; ++l) b.per_area[l] = 1.0 / (b.area[l] * b.det[l]);
    add_overlaps(b, sum);
#pragma omp simd
    for (int l = 0; l < b.count; ++l) {
        const LensPotential::Sums s{sum.base[l], sum.q0[l], sum.q1[l], sum.q1_squared[l], sum.local[l]};
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
        sum.base[l] = left;
    }
    answer_all(b, sum);
#pragma omp simd
    for (int l = 0; l < b.count; ++l)
        b.stress[l] =
            b.pressure[l] * (sum.base[l] + sum.h_slope[l]) + (1.0 / 3.0) * b.plane_E[l] * sum.local[l];
}

SOFTGRAIN_CLONES void press_neo_hookean(PressureBlock& block) {
    press<GrainLaw::neo_hookean>(block);
}
SOFTGRAIN_CLONES void press_linear(PressureBlock& block) {
    press<GrainLaw::linear>(block);
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
