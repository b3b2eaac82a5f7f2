#pragma once
// How much a grain may deform: which part of F' is free, and what is imposed on F after a step.
#include <algorithm>
#include <cmath>
#include <string_view>

#include "sdem/polar.hpp"

namespace softgrain::sdem {

/// The paper's names: two dimensions, number of deformation modes.
enum class Kinematics {
    D2F0,  ///< rigid disc
    D2F1,  ///< volumetric only
    D2F3,  ///< full
};

/// Share of `rate` along `direction`, as a factor.
inline double share(const Mat2& rate, const Mat2& direction) {
    return rate.cwiseProduct(direction).sum() / direction.squaredNorm();
}

/// F' = spin * turned(F) turns the grain without deforming it.
inline Mat2 turned(const Mat2& F) {
    Mat2 W;
    W << -F(1, 0), -F(1, 1), F(0, 0), F(0, 1);
    return W;
}

/// The part of F' that deforms the grain: without the spin that carries all its angular momentum.
inline Mat2 without_spin(const Mat2& F, const Mat2& F_rate) {
    const Mat2 W = turned(F);
    return F_rate - share(F_rate, W) * W;
}

/// Largest change of eps_iso that one step may impose, so that a violent change cannot run away.
inline constexpr double largest_dilation_step = 1e-3;

/// Kinematics known at compile time. `Incompressible` only acts on grains that can change their area.
template <Kinematics K, bool Incompressible>
struct Motion {
    static constexpr bool imposes_area = Incompressible && K != Kinematics::D2F0;
    static constexpr bool corrects = imposes_area || K == Kinematics::D2F0;

    /// F' without what these kinematics do not allow. Nothing taken away carries angular momentum.
    static Mat2 allowed(const Mat2& F, const Mat2& F_rate) {
        if constexpr (K == Kinematics::D2F3 && !imposes_area) {
            return F_rate;
        } else {
            const Mat2 R = Polar(F).rotation();
            if constexpr (K == Kinematics::D2F3) {
                return F_rate - share(F_rate, R) * R;
            } else {
                const Mat2 W = turned(R);
                const Mat2 spin = share(F_rate, W) * W;
                if constexpr (K == Kinematics::D2F0 || imposes_area)
                    return spin;
                else
                    return spin + share(F_rate, R) * R;
            }
        }
    }

    /// F after the step, put back on what these kinematics allow. `cap_fraction` = sum S / (pi R^2).
    static Mat2 corrected(const Mat2& F, double cap_fraction) {
        if constexpr (K == Kinematics::D2F0) {
            return Polar(F).rotation();
        } else if constexpr (imposes_area) {
            // Eq. 67, 68: eps_iso = sqrt(1 + sum S/(pi R^2) + d^2) - 1.
            const Polar polar(F);
            const double d = half_stretch_difference(F);
            const double wanted = std::sqrt(1.0 + cap_fraction + d * d) - 0.5 * polar.trace;
            return F + std::clamp(wanted, -largest_dilation_step, largest_dilation_step) * polar.rotation();
        } else {
            return F;
        }
    }

    /// F' after F was corrected: allowed at the new F, with the angular momentum it had before.
    static Mat2 carried(const Mat2& before, const Mat2& corrected, const Mat2& F_rate) {
        const Mat2 kept = allowed(corrected, F_rate), W = turned(corrected);
        const double lost = F_rate.cwiseProduct(turned(before)).sum() - kept.cwiseProduct(W).sum();
        return kept + (lost / W.squaredNorm()) * W;
    }
};

/// "D2F0", "D2F1" or "D2F3"; throws InputError.
Kinematics kinematics_from(std::string_view name);

}  // namespace softgrain::sdem
