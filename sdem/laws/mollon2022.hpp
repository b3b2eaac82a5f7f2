#pragma once
// The contact and stress law as printed: Mollon 2022, Eq. 41-46 and 54-57. Tension positive inside a grain.
#include <cmath>

#include "common/simd.hpp"

#include "sdem/laws/contact_input.hpp"
#include "sdem/tensor.hpp"

namespace softgrain::sdem {

struct Mollon2022 {
    static constexpr bool uses_openings = true;  ///< needs the opening angles of caps
    static constexpr double a = 0.58;            ///< Section 4.2
    static constexpr double b = 2.0;

    /// Secant stiffness k_n of Eq. 57; delta = -delta_n > 0 in contact.
    static SOFTGRAIN_INLINE double stiffness(double E, double length, double delta) {
        return E * length / (a * length - (b - 1.0) * delta);
    }
    /// Stiffness of a contact that has just closed: the limit of Eq. 57.
    static SOFTGRAIN_INLINE double first_stiffness(double E) { return E / a; }

    /// Eq. 56 and 61, divided by the chord's length; `damping` is gamma.
    static SOFTGRAIN_INLINE ContactAnswer contact(const ContactInput& c, double damping) {
        const double k_n = stiffness(c.E, c.length, c.delta);
        const double per_length = 1.0 / c.length;
        return {k_n * c.delta * per_length, damping * std::sqrt(std::abs(k_n) * c.mass) * c.rate * per_length,
                k_n};
    }

    /// sum S / (pi R^2) as Eq. 41 takes it. Once caps cover more than the whole outline they overlap: the sum
    /// counts areas twice, grows faster than the area it is to be weighed against, and Eq. 41 and 68 run
    /// away. Scaled back by (pi/sum psi)^3, as caps go with psi^3, each outline is counted once.
    static SOFTGRAIN_INLINE double cap_fraction(double caps, double covered, double reference_area) {
        const double once = covered > 1.0 ? covered : 1.0;
        return caps / (reference_area * once * once * once);
    }
};

/// First Piola-Kirchhoff stress R [2 mu dev(U) + kappa eps_V I], Eq. 39-43 with F = R U.
SOFTGRAIN_INLINE Tensor linear_piola(const Tensor& F, double mu, double kappa, double eps_v) {
    const Polar polar(F);
    const double sphere = kappa * eps_v - mu * polar.trace;
    return 2.0 * mu * F + sphere * polar.rotation();
}

}  // namespace softgrain::sdem
