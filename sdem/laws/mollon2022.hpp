#pragma once
// The contact and stress law as printed: Mollon 2022, Eq. 41-46 and 54-57. Tension positive inside a grain.
#include <algorithm>
#include <cmath>

#include "sdem/polar.hpp"

namespace softgrain::sdem {

/// Normal force of one contact [N], compression positive.
struct NormalForce {
    double total;      ///< N, never negative
    double damping;    ///< part of N due to the damping term
    double stiffness;  ///< k_n [N/m]; not positive if the law does not hold for this shape of cap
};

/// Plane-strain isotropic elasticity with the paper's heuristic contact stiffness.
struct Mollon2022 {
    static constexpr double a = 0.58;  ///< Section 4.2
    static constexpr double b = 2.0;

    double E;        ///< [N/m]
    double mu;       ///< Eq. 45
    double kappa;    ///< Eq. 46; 0 if nu = 0.5 (Eq. 65, 66)
    double damping;  ///< gamma of Eq. 61

    static Mollon2022 from(double youngs_modulus, double poisson_ratio, double contact_damping) {
        const double nu = poisson_ratio;
        return {youngs_modulus, youngs_modulus / (2.0 * (1.0 + nu)),
                nu < 0.5 ? youngs_modulus / (3.0 - 6.0 * nu) : 0.0, contact_damping};
    }

    /// Secant stiffness k_n of Eq. 57; delta_n < 0 in contact.
    double stiffness(double length, double delta_n) const {
        return E * length / (a * length + (b - 1.0) * delta_n);
    }

    /// Stiffness of a contact that has just closed: the limit of Eq. 57.
    double first_stiffness() const { return E / a; }

    /// Eq. 56 and 61; `rate` is d(delta_n)/dt, `mass` is 1/(1/M_i + 1/M_j).
    NormalForce normal_force(double length, double delta_n, double rate, double mass) const {
        const double k_n = stiffness(length, delta_n);
        const double elastic = -k_n * delta_n;
        const double total = std::max(0.0, elastic - damping * std::sqrt(k_n * mass) * rate);
        return {total, total - elastic, k_n};
    }

    /// First Piola-Kirchhoff stress R [2 mu dev(U) + kappa eps_V I], Eq. 39-43 with F = R U.
    Mat2 piola(const Mat2& F, const Polar& polar, double eps_v) const {
        const double sphere = kappa * eps_v - mu * polar.trace;
        Mat2 P;
        P << 2.0 * mu * F(0, 0) + sphere * polar.cosine, 2.0 * mu * F(0, 1) - sphere * polar.sine,
            2.0 * mu * F(1, 0) + sphere * polar.sine, 2.0 * mu * F(1, 1) + sphere * polar.cosine;
        return P;
    }
};

}  // namespace softgrain::sdem
