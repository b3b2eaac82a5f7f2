#pragma once
// Perfect plasticity of the deviator of a neo-Hookean grain: F = Fe Fp with det Fp = 1, flow kept in
// G = (Fp^T Fp)^-1, so that be = F G F^T (Simo and Hughes, Computational Inelasticity, section 9.2).
#include <cmath>

#include "common/simd.hpp"

#include "sdem/tensor.hpp"

namespace softgrain::sdem {

/// G: symmetric, determinant 1; the identity before any flow.
struct PlasticState {
    double xx, xy, yy;
};

struct PlasticFlow {
    PlasticState state;
    double work;  ///< dissipated, per reference area [N/m]
};

/// F G F^T / det F: symmetric with determinant 1.
SOFTGRAIN_INLINE PlasticState elastic_strain(const Tensor& F, const PlasticState& G) {
    const double per_area = 1.0 / F.det();
    const double ux = F.xx * G.xx + F.xy * G.xy, uy = F.xx * G.xy + F.xy * G.yy;
    const double vx = F.yx * G.xx + F.yy * G.xy, vy = F.yx * G.xy + F.yy * G.yy;
    return {per_area * (ux * F.xx + uy * F.xy), per_area * (ux * F.yx + uy * F.yy),
            per_area * (vx * F.yx + vy * F.yy)};
}

/// asinh(z) for z >= 0: relative error z^6 / 200 where z is small, 0.5 % at z = 1.
SOFTGRAIN_INLINE double inverse_sinh(double z) {
    const double square = z * z;
    return z * (1.0 + 17.0 / 60.0 * square) / (1.0 + 9.0 / 20.0 * square);
}

/// Kirchhoff stress of the deviator is mu dev(be/J), with principal values +- mu (l - 1/l)/2, l and 1/l those
/// of be/J. Beyond the yield stress l is set back to where it is reached: an exact radial return. `yield` is
/// the largest shear stress [N/m].
SOFTGRAIN_INLINE PlasticFlow return_to_yield(const Tensor& F, const PlasticState& G, double mu,
                                             double yield) {
    const PlasticState b = elastic_strain(F, G);
    const double half_trace = 0.5 * (b.xx + b.yy);  // (l + 1/l)/2 >= 1
    const double half_difference = 0.5 * (b.xx - b.yy);
    const double shear = std::sqrt(half_difference * half_difference + b.xy * b.xy);  // (l - 1/l)/2
    const double most = yield / mu;
    const bool flows = shear > most;
    // The same axes with a smaller deviator: b' = t' I + (s'/s) dev b.
    const double new_shear = flows ? most : shear;
    const double new_half_trace = flows ? std::sqrt(1.0 + new_shear * new_shear) : half_trace;
    const double scale = flows ? new_shear / shear : 1.0;
    const double xx = new_half_trace + scale * half_difference, xy = scale * b.xy,
                 yy = new_half_trace - scale * half_difference;
    // G = J F^-1 b' F^-T, with the cofactor C = J F^-T.
    const Tensor C = F.cofactor();
    const double per_area = 1.0 / F.det();
    const double ux = C.xx * xx + C.yx * xy, uy = C.xx * xy + C.yx * yy;
    const double vx = C.xy * xx + C.yy * xy, vy = C.xy * xy + C.yy * yy;
    const PlasticState flowed{per_area * (ux * C.xx + uy * C.yx), per_area * (ux * C.xy + uy * C.yy),
                              per_area * (vx * C.xy + vy * C.yy)};
    // Work of the yield stress over the plastic stretch, the change of log l. What the elastic energy loses
    // at fixed F is more by the square of the step: that is not dissipated but an error of the step.
    const double stretch = inverse_sinh(shear * new_half_trace - half_trace * new_shear);
    return {{flows ? flowed.xx : G.xx, flows ? flowed.xy : G.xy, flows ? flowed.yy : G.yy},
            flows ? mu * new_shear * stretch : 0.0};
}

/// First Piola-Kirchhoff stress of w = mu/2 (tr(be)/J - 2).
SOFTGRAIN_INLINE Tensor elastic_deviator(const Tensor& F, const PlasticState& G, double mu) {
    const PlasticState b = elastic_strain(F, G);
    const Tensor FG{F.xx * G.xx + F.xy * G.xy, F.xx * G.xy + F.xy * G.yy, F.yx * G.xx + F.yy * G.xy,
                    F.yx * G.xy + F.yy * G.yy};
    const double J = F.det();
    return (mu / J) * (FG - (0.5 * (b.xx + b.yy)) * F.cofactor());
}

}  // namespace softgrain::sdem
