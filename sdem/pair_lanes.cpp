#include "sdem/pair_lanes.hpp"

#include <cmath>

#include "common/simd.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {
namespace {

/// From grains side by side to numbers side by side.
template <bool rates, bool periodic>
SOFTGRAIN_INLINE void unfold(PairLanes& batch) {
    ChordBatch& c = batch.chord;
    const int count = batch.count;
#pragma omp simd
    for (int l = 0; l < count; ++l) {
        const Grain &a = batch.a[l], &b = batch.b[l];
        c.dx[l] = b.x - a.x;
        c.dy[l] = b.y - a.y;
        c.a_xx[l] = a.a * a.F.xx;
        c.a_xy[l] = a.b * a.F.xy;
        c.a_yx[l] = a.a * a.F.yx;
        c.a_yy[l] = a.b * a.F.yy;
        c.b_xx[l] = b.a * b.F.xx;
        c.b_xy[l] = b.b * b.F.xy;
        c.b_yx[l] = b.a * b.F.yx;
        c.b_yy[l] = b.b * b.F.yy;
        if constexpr (rates) {
            batch.dvx[l] = b.vx - a.vx;
            batch.dvy[l] = b.vy - a.vy;
            batch.a_rxx[l] = a.a * a.F_rate.xx;
            batch.a_rxy[l] = a.b * a.F_rate.xy;
            batch.a_ryx[l] = a.a * a.F_rate.yx;
            batch.a_ryy[l] = a.b * a.F_rate.yy;
            batch.b_rxx[l] = b.a * b.F_rate.xx;
            batch.b_rxy[l] = b.b * b.F_rate.xy;
            batch.b_ryx[l] = b.a * b.F_rate.yx;
            batch.b_ryy[l] = b.b * b.F_rate.yy;
            batch.mass_a[l] = a.mass;
            batch.mass_b[l] = b.mass;
        }
    }
#pragma omp simd
    for (int l = 0; l < count; ++l) {
        c.end_ax[l] = static_cast<double>(batch.guess[l].ax);
        c.end_ay[l] = static_cast<double>(batch.guess[l].ay);
        c.end_bx[l] = static_cast<double>(batch.guess[l].bx);
        c.end_by[l] = static_cast<double>(batch.guess[l].by);
    }
    if constexpr (periodic) {
#pragma omp simd
        for (int l = 0; l < count; ++l) {
            c.dx[l] += batch.offset_x[l];
            c.dy[l] += batch.offset_y[l];
            if constexpr (rates) {
                batch.dvx[l] += batch.offset_vx[l];
                batch.dvy[l] += batch.offset_vy[l];
            }
        }
    }
    c.count = count;
}

SOFTGRAIN_CLONES void unfold_moving(PairLanes& batch) {
    unfold<true, false>(batch);
}
SOFTGRAIN_CLONES void unfold_resting(PairLanes& batch) {
    unfold<false, false>(batch);
}
SOFTGRAIN_CLONES void unfold_moving_images(PairLanes& batch) {
    unfold<true, true>(batch);
}
SOFTGRAIN_CLONES void unfold_resting_images(PairLanes& batch) {
    unfold<false, true>(batch);
}

/// `rates`: velocities at the chord's mid-point are known and wanted.
template <class Law, bool rates>
SOFTGRAIN_INLINE void answer_each(PairLanes& batch, double damping) {
    ChordBatch& c = batch.chord;
    const int count = batch.count;
#pragma omp simd
    for (int l = 0; l < count; ++l) {
        const double length = std::sqrt(c.chord_x[l] * c.chord_x[l] + c.chord_y[l] * c.chord_y[l]);
        double closing = 0.0, slip = 0.0, mass = 1.0;
        if constexpr (rates) {
            const double per_length = 1.0 / length;
            const double nx = c.chord_x[l] * per_length, ny = c.chord_y[l] * per_length;
            // Material points of both grains at the chord's mid-point.
            const Tensor A{c.a_xx[l], c.a_xy[l], c.a_yx[l], c.a_yy[l]};
            const Tensor B{c.b_xx[l], c.b_xy[l], c.b_yx[l], c.b_yy[l]};
            const double ax = c.mid_x[l], ay = c.mid_y[l], bx = ax - c.dx[l], by = ay - c.dy[l];
            const double to_a = 1.0 / A.det(), to_b = 1.0 / B.det();
            const double ua = to_a * (A.yy * ax - A.xy * ay), va = to_a * (A.xx * ay - A.yx * ax);
            const double ub = to_b * (B.yy * bx - B.xy * by), vb = to_b * (B.xx * by - B.yx * bx);
            const double wx = batch.dvx[l] + (batch.b_rxx[l] * ub + batch.b_rxy[l] * vb) -
                              (batch.a_rxx[l] * ua + batch.a_rxy[l] * va);
            const double wy = batch.dvy[l] + (batch.b_ryx[l] * ub + batch.b_ryy[l] * vb) -
                              (batch.a_ryx[l] * ua + batch.a_ryy[l] * va);
            closing = -(nx * wx + ny * wy);
            slip = nx * wy - ny * wx;
            mass = batch.mass_a[l] * batch.mass_b[l] / (batch.mass_a[l] + batch.mass_b[l]);
        }
        const double E_a = batch.E_a[l], E_b = batch.E_b[l];
        const ContactInput input{length, 0.5 * c.depth[l], 0.5 * closing, 2.0 * E_a * E_b / (E_a + E_b),
                                 mass};
        const ContactAnswer answer = Law::contact(input, damping);
        const bool touching = c.sound[l] != 0.0, turned = batch.turn[l] < 0.0;
        const double turn = batch.turn[l];
        const double arm_x = turned ? c.mid_x[l] - c.dx[l] : c.mid_x[l];
        const double arm_y = turned ? c.mid_y[l] - c.dy[l] : c.mid_y[l];
        const double cap_i = turned ? c.cap_b[l] : c.cap_a[l], cap_j = turned ? c.cap_a[l] : c.cap_b[l];
        Contact& to = batch.contact[l];
        to.chord_x = touching ? turn * c.chord_x[l] : 0.0;
        to.chord_y = touching ? turn * c.chord_y[l] : 0.0;
        to.arm_x = touching ? arm_x : 0.0;
        to.arm_y = touching ? arm_y : 0.0;
        to.cap_i = touching ? cap_i : 0.0;
        to.cap_j = touching ? cap_j : 0.0;
        to.q = touching ? answer.q : 0.0;
        to.q_damping = touching ? answer.q_damping : 0.0;
        batch.slip[l] = touching ? slip : 0.0;
        batch.stiffness[l] = touching ? answer.stiffness : 1.0;
    }
#pragma omp simd
    for (int l = 0; l < count; ++l) {
        batch.guess[l].ax = static_cast<float>(c.end_ax[l]);
        batch.guess[l].ay = static_cast<float>(c.end_ay[l]);
        batch.guess[l].bx = static_cast<float>(c.end_bx[l]);
        batch.guess[l].by = static_cast<float>(c.end_by[l]);
    }
    if constexpr (Law::uses_openings) {
#pragma omp simd
        for (int l = 0; l < count; ++l) {
            const bool turned = batch.turn[l] < 0.0, touching = c.sound[l] != 0.0;
            const double psi_i = turned ? c.cover_b[l] : c.cover_a[l],
                         psi_j = turned ? c.cover_a[l] : c.cover_b[l];
            batch.opening[l].psi_i = static_cast<float>(touching ? psi_i : 0.0);
            batch.opening[l].psi_j = static_cast<float>(touching ? psi_j : 0.0);
        }
    }
}

SOFTGRAIN_CLONES void answer_lens(PairLanes& batch, double damping) {
    answer_each<LensPotential, true>(batch, damping);
}
SOFTGRAIN_CLONES void answer_lens_at_rest(PairLanes& batch) {
    answer_each<LensPotential, false>(batch, 0.0);
}
SOFTGRAIN_CLONES void answer_mollon(PairLanes& batch, double damping) {
    answer_each<Mollon2022, true>(batch, damping);
}
SOFTGRAIN_CLONES void answer_mollon_at_rest(PairLanes& batch) {
    answer_each<Mollon2022, false>(batch, 0.0);
}

void unfold_lanes(PairLanes& batch, bool with_rates, bool periodic) {
    if (periodic)
        with_rates ? unfold_moving_images(batch) : unfold_resting_images(batch);
    else
        with_rates ? unfold_moving(batch) : unfold_resting(batch);
}

}  // namespace

void find_chords(PairLanes& batch, bool with_rates, bool periodic) {
    unfold_lanes(batch, with_rates, periodic);
    solve_chords(batch.chord);
}

void skip_chords(PairLanes& batch, bool with_rates, bool periodic) {
    unfold_lanes(batch, with_rates, periodic);
    for (double& sound : batch.chord.sound) sound = 0.0;
}

void answer_lanes(PairLanes& batch, ContactLaw law, bool with_rates, double damping) {
    if (law == ContactLaw::lens_potential)
        with_rates ? answer_lens(batch, damping) : answer_lens_at_rest(batch);
    else
        with_rates ? answer_mollon(batch, damping) : answer_mollon_at_rest(batch);
}

}  // namespace softgrain::sdem
