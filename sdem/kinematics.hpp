#pragma once
// How much a grain may deform: which part of F' is free, and what is imposed on F after a step.
#include <algorithm>
#include <cmath>

#include "common/simd.hpp"

#include "sdem/motion_law.hpp"
#include "sdem/tensor.hpp"

namespace softgrain::sdem {

/// Inertia of a grain's deformation about its reference axes: M = m a^2/4 and m b^2/4, a column of F each.
struct Inertia {
    double x, y;  ///< [kg m^2]

    SOFTGRAIN_INLINE Tensor times(const Tensor& rate) const {
        return {x * rate.xx, y * rate.xy, x * rate.yx, y * rate.yy};
    }
    SOFTGRAIN_INLINE Tensor divides(const Tensor& moment) const {
        const double to_x = 1.0 / x, to_y = 1.0 / y;
        return {to_x * moment.xx, to_y * moment.xy, to_x * moment.yx, to_y * moment.yy};
    }
    /// Share of `rate` along `direction`, as a factor.
    SOFTGRAIN_INLINE double share(const Tensor& rate, const Tensor& direction) const {
        const Tensor weighted = times(direction);
        return contraction(rate, weighted) / contraction(direction, weighted);
    }
};

/// The part of F' that deforms the grain: without the spin that carries all its angular momentum.
SOFTGRAIN_INLINE Tensor without_spin(const Tensor& F, const Tensor& rate, const Inertia& inertia) {
    const Tensor W = F.turned();
    return rate - inertia.share(rate, W) * W;
}

/// Largest change of eps_iso that one step may impose, so that a violent change cannot run away.
inline constexpr double largest_dilation_step = 1e-3;

/// Kinematics known at compile time. `Incompressible` only acts on grains that can change their area.
template <Kinematics K, bool Incompressible>
struct Motion {
    static constexpr bool imposes_area = Incompressible && K != Kinematics::D2F0;
    static constexpr bool corrects = imposes_area || K == Kinematics::D2F0;
    static constexpr bool constrains = imposes_area || K != Kinematics::D2F3;

    /// F' without what these kinematics do not allow. Nothing taken away carries angular momentum.
    static SOFTGRAIN_INLINE Tensor allowed(const Tensor& F, const Tensor& rate, const Inertia& inertia) {
        if constexpr (!constrains) {
            return rate;
        } else {
            const Tensor R = Polar(F).rotation();
            if constexpr (K == Kinematics::D2F3) {
                return rate - inertia.share(rate, R) * R;
            } else {
                const Tensor W = R.turned();
                const Tensor spin = inertia.share(rate, W) * W;
                if constexpr (K == Kinematics::D2F0 || imposes_area)
                    return spin;
                else
                    return spin + inertia.share(rate, R) * R;
            }
        }
    }

    /// F after the step, put back on what these kinematics allow. `cap_fraction` = sum S / (pi R^2).
    static SOFTGRAIN_INLINE Tensor corrected(const Tensor& F, double cap_fraction) {
        if constexpr (K == Kinematics::D2F0) {
            return Polar(F).rotation();
        } else if constexpr (imposes_area) {
            // Eq. 67, 68: eps_iso = sqrt(1 + sum S/(pi R^2) + d^2) - 1.
            const Polar polar(F);
            const double d = half_stretch_difference(F);
            const double wanted = std::sqrt(1.0 + cap_fraction + d * d) - 0.5 * polar.trace;
            const double step = std::min(std::max(wanted, -largest_dilation_step), largest_dilation_step);
            return F + step * polar.rotation();
        } else {
            return F;
        }
    }

    /// F' after F was corrected: allowed at the new F, with the angular momentum it had before.
    static SOFTGRAIN_INLINE Tensor carried(const Tensor& before, const Tensor& corrected, const Tensor& rate,
                                           const Inertia& inertia) {
        const Tensor kept = allowed(corrected, rate, inertia), W = corrected.turned();
        const double lost =
            contraction(inertia.times(rate), before.turned()) - contraction(inertia.times(kept), W);
        return kept + (lost / contraction(inertia.times(W), W)) * W;
    }
};

}  // namespace softgrain::sdem
