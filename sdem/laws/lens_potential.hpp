#pragma once
// A conservative law: one potential for the whole sample, forces and stresses by differentiation.
//
//     U = sum over grains A0 [ w(F) + u(Je) + 2/3 c0 E* sum_k s_k^(3/2) ],   Je = J - G(T),   T = sum_k s_k
//
// s_k = beta S_k / A0 is the overlap of contact k that the grain gives way to (S_k the area of the whole
// lens), beta_i = R_j E*_j / (R_i E*_i + R_j E*_j), 1 at a wall. What a cap displaces first bulges beside the
// contact and then inflates the grain: G(T) = T (1 - chi exp(-T/T0)). Constants fitted on single grains
// between walls.
#include <cmath>

#include "common/simd.hpp"

#include "sdem/laws/contact_input.hpp"
#include "sdem/laws/elementary.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {

struct LensPotential {
    static constexpr bool uses_openings = false;  ///< needs the opening angles of caps
    static constexpr double c0 = 1.008;
    static constexpr double T0 = 0.0966;
    static constexpr double gamma = 0.444;

    /// chi
    static SOFTGRAIN_INLINE double bulge(double nu) { return 1.0 - gamma * (1.0 - 2.0 * nu) / (1.0 - nu); }

    /// G(T) and its derivative.
    struct Inflation {
        double G, slope;
    };
    static SOFTGRAIN_INLINE Inflation inflation(double T, double chi) {
        const double x = T / T0, e = chi * exp_minus(x);
        return {T * (1.0 - e), 1.0 - e * (1.0 - x)};
    }

    /// u of the neo-Hookean grain under in-plane dilation, per reference area [N/m].
    static SOFTGRAIN_INLINE double dilation_energy(double J, double mu, double kappa) {
        const double third = inverse_cube_root(J);
        return 0.5 * mu * (third * third * (2.0 * J + 1.0) - 3.0) + 0.5 * kappa * (J - 1.0) * (J - 1.0);
    }
    /// p = -u' [N/m]
    static SOFTGRAIN_INLINE double pressure(double J, double mu, double kappa) {
        const double third = inverse_cube_root(J), two_thirds = third * third;
        return mu * (two_thirds * (2.0 * J + 1.0) / (3.0 * J) - two_thirds) - kappa * (J - 1.0);
    }
    /// Bound of u'' used for the time step [N/m].
    static SOFTGRAIN_INLINE double bulk_stiffness(double mu, double kappa) { return kappa + mu; }

    static SOFTGRAIN_INLINE ContactAnswer contact(const ContactInput& c, double damping) {
        const double q = c0 * (c.stiff_i * std::sqrt(c.s_i) + c.stiff_j * std::sqrt(c.s_j));
        const double k_n = std::abs(Mollon2022::stiffness(c.E, c.length, c.delta));
        return {q, damping * std::sqrt(k_n * c.mass) * c.rate / c.length, k_n};
    }
    /// Local energy of one grain's side, per reference area [N/m].
    static SOFTGRAIN_INLINE double contact_energy(double plane_E, double s) {
        return (2.0 / 3.0) * c0 * plane_E * s * std::sqrt(s);
    }
};

}  // namespace softgrain::sdem
