#pragma once
// Extra inertia against changes of a grain's area, for nearly incompressible grains that shall take long
// steps.
#include <algorithm>
#include <cmath>

#include "sdem/kinematics.hpp"

namespace softgrain::sdem {

/// d(det F)/dt.
SOFTGRAIN_INLINE double dilation_rate(const Tensor& F, const Tensor& rate) {
    return contraction(F.cofactor(), rate);
}

/// Adds s/2 (d(det F)/dt)^2 to the kinetic energy. A spin changes no area, so angular momentum is as without.
struct DilationInertia {
    double s;  ///< [kg m^2]

    /// sigma: in units of the undeformed grain's own inertia against dilation.
    SOFTGRAIN_INLINE DilationInertia(const Inertia& own, double sigma)
        : s(sigma * own.x * own.y / (own.x + own.y)) {}

    /// Momentum of a rate, as a factor of C = d(det F)/dF.
    SOFTGRAIN_INLINE double momentum(const Tensor& F, const Tensor& rate) const {
        return s * dilation_rate(F, rate);
    }

    /// The rate after a kick, from `kicked`, the rate that it would be without this inertia. With D the
    /// change of det F over a drift divided by its length, the discrete Euler-Lagrange equation is M kicked +
    /// s D_last C = M rate + s D_next C, quadratic in D_next. Exact for drifts of any two lengths, so energy
    /// does not drift.
    SOFTGRAIN_INLINE Tensor slowed(const Tensor& F, const Tensor& before, const Tensor& kicked,
                                   const Inertia& own, double last_drift, double next_drift) const {
        const Tensor C = F.cofactor(), D = own.divides(C);
        const double last = contraction(C, before) - last_drift * before.det();
        const double missing = contraction(C, kicked) + next_drift * kicked.det() - last;
        const double linear = 1.0 + s * (contraction(C, D) + next_drift * contraction(kicked.cofactor(), D));
        const double square = 4.0 * s * s * next_drift * D.det() * missing;
        return kicked -
               (2.0 * s * missing / (linear + std::sqrt(std::max(0.0, linear * linear - square)))) * D;
    }
};

}  // namespace softgrain::sdem
