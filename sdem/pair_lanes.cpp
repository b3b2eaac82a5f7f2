#include "sdem/pair_lanes.hpp"

#include <cmath>

#include "common/simd.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {
namespace {

/// Local forces of all lanes. `Rates`: velocities at the chord's mid-point are known and wanted.
template <class Law, bool Rates>
SOFTGRAIN_INLINE void answer_each(PairLanes& batch, double damping) {
    ChordBatch& c = batch.chord;
    const int count = c.count;
#pragma omp simd
    for (int l = 0; l < count; ++l) {
        const double length = std::sqrt(c.chord_x[l] * c.chord_x[l] + c.chord_y[l] * c.chord_y[l]);
        const double nx = c.chord_x[l] / length, ny = c.chord_y[l] / length;
        double closing = 0.0, slip = 0.0;
        if constexpr (Rates) {
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
        }
        // The smaller and the softer grain gives way.
        const double weight_a = batch.radius_b[l] * batch.plane_E_b[l];
        const double weight_b = batch.radius_a[l] * batch.plane_E_a[l];
        const double share_a = weight_a / (weight_a + weight_b), share_b = 1.0 - share_a;
        const double lens = c.cap_a[l] + c.cap_b[l];
        constexpr double inverse_pi = 0.318309886183790671538;
        const double s_a = share_a * lens * inverse_pi / (batch.radius_a[l] * batch.radius_a[l]);
        const double s_b = share_b * lens * inverse_pi / (batch.radius_b[l] * batch.radius_b[l]);
        const ContactInput input{length,
                                 0.5 * c.depth[l],
                                 0.5 * closing,
                                 s_a,
                                 s_b,
                                 share_a * batch.plane_E_a[l],
                                 share_b * batch.plane_E_b[l],
                                 2.0 * batch.E_a[l] * batch.E_b[l] / (batch.E_a[l] + batch.E_b[l]),
                                 batch.mass_a[l] * batch.mass_b[l] / (batch.mass_a[l] + batch.mass_b[l])};
        const ContactAnswer answer = Law::contact(input, damping);
        batch.q[l] = answer.q;
        batch.q_damping[l] = answer.q_damping;
        batch.stiffness[l] = answer.stiffness;
        batch.share_a[l] = share_a;
        batch.slip[l] = slip;
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

}  // namespace

void answer_lanes(PairLanes& batch, ContactLaw law, bool with_rates, double damping) {
    if (law == ContactLaw::lens_potential)
        with_rates ? answer_lens(batch, damping) : answer_lens_at_rest(batch);
    else
        with_rates ? answer_mollon(batch, damping) : answer_mollon_at_rest(batch);
}

}  // namespace softgrain::sdem
