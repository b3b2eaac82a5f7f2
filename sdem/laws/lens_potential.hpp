#pragma once
// A conservative law: one potential for the whole sample, forces and stresses by differentiation.
//
//     U = sum over grains A0 [ w(F) + u(Je) + 2/3 E* J sum_k h_k^(3/2) ],   Je = J (1 - G)
//
// h_k = beta S_k / (A0 J) is the overlap of contact k that the grain gives way to (S_k the area of the whole
// lens), beta_i = R_j E*_j / (R_i E*_i + R_j E*_j), 1 at a wall. What a cap displaces first bulges beside the
// contact and inflates the grain only when the bulges of neighbouring contacts meet:
//
//     G = sum h^2/(h + s0) + s0 Q0 (1 - chi),   Q0 = sum h/(h + s0) rho,   rho = r/(r + r0),   r = sqrt(h)
//     chi = (a - gamma (1-2nu)/(1-nu)) b,   a = 1/(1 + (n/n0)^8),   b = 1/(1 + (Q1/Qc)^16)
//     n = Q1^2/Q2,   Q1 = sum q1,   Q2 = sum q1^2,   q1 = h/(h + s1) rho
//
// Constants fitted on resolved single grains between two, four, six and eight walls.
#include <cmath>

#include "common/simd.hpp"

#include "sdem/laws/contact_input.hpp"
#include "sdem/laws/elementary.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {

struct LensPotential {
    static constexpr bool uses_openings = false;  ///< needs the opening angles of caps
    static constexpr double r0 = 0.01;
    static constexpr double s0 = 0.020;
    static constexpr double s1 = 0.012;
    static constexpr double gamma = 0.22;
    static constexpr double n0 = 5.5;
    static constexpr double Qc = 3.17;

    /// gamma (1-2nu)/(1-nu)
    static SOFTGRAIN_INLINE double bulge(double nu) { return gamma * (1.0 - 2.0 * nu) / (1.0 - nu); }

    /// What one contact adds to the sums over a grain's contacts, and its derivatives by h. All zero, and
    /// none infinite, for h = 0.
    struct Overlap {
        double h, r;
        double base, q0, q1;  ///< h^2/(h + s0), and the terms of Q0 and Q1
        double base_slope, q0_slope, q1_slope;
    };
    static SOFTGRAIN_INLINE Overlap overlap(double h) {
        const double r = std::sqrt(h), R = r + r0, H0 = h + s0, H1 = h + s1;
        const double inverse = 1.0 / (R * H0 * H1);  // one division for three
        const double per_R = inverse * (H0 * H1), per_H0 = inverse * (R * H1), per_H1 = inverse * (R * H0);
        const double rho = r * per_R, h_rho_slope = 0.5 * r0 * rho * per_R;
        const double part0 = h * per_H0, part1 = h * per_H1;
        return {h,
                r,
                h * part0,
                part0 * rho,
                part1 * rho,
                part0 * (1.0 + s0 * per_H0),
                per_H0 * (s0 * per_H0 * rho + h_rho_slope),
                per_H1 * (s1 * per_H1 * rho + h_rho_slope)};
    }

    /// Sums over a grain's contacts, in their order.
    struct Sums {
        double base = 0.0, q0 = 0.0, q1 = 0.0, q1_squared = 0.0;
        double local = 0.0;  ///< sum h r

        SOFTGRAIN_INLINE void add(const Overlap& o) {
            base += o.base;
            q0 += o.q0;
            q1 += o.q1;
            q1_squared += o.q1 * o.q1;
            local += o.h * o.r;
        }
    };

    /// G, and what dG/dh_k = base' + at_q0 q0' + (at_q1 + at_q1_squared q1) q1' of each contact needs.
    struct Inflation {
        double G, at_q0, at_q1, at_q1_squared;

        SOFTGRAIN_INLINE double slope(double base_slope, double q0_slope, double q1, double q1_slope) const {
            return base_slope + at_q0 * q0_slope + (at_q1 + at_q1_squared * q1) * q1_slope;
        }
        SOFTGRAIN_INLINE double slope(const Overlap& o) const {
            return slope(o.base_slope, o.q0_slope, o.q1, o.q1_slope);
        }
    };
    static SOFTGRAIN_INLINE Inflation inflation(const Sums& sum, double bulge) {
        constexpr double none = 1e-200;  // keeps 0/0 of a grain without contacts at 0
        const double per_Q1 = 1.0 / (sum.q1 + none), per_Q2 = 1.0 / (sum.q1_squared + none);
        double x = sum.q1 * sum.q1 * per_Q2 * (1.0 / n0);
        x *= x;
        x *= x;
        x *= x;
        double w = sum.q1 * (1.0 / Qc);
        w *= w;
        w *= w;
        w *= w;
        w *= w;
        const double a = 1.0 / (1.0 + x), b = 1.0 / (1.0 + w), left = a - bulge;
        const double spread = s0 * (1.0 - left * b), pull = 16.0 * s0 * sum.q0 * b, few = pull * x * a * a;
        return {sum.base + spread * sum.q0, spread, (few + pull * left * w * b) * per_Q1, -few * per_Q2};
    }

    /// Second derivative of G by the h of one contact, without that of chi by its own powers: for the time
    /// step.
    static SOFTGRAIN_INLINE double curvature(const Overlap& o, const Inflation& in) {
        const double R = o.r + r0, H0 = o.h + s0, H1 = o.h + s1;
        const double inverse = 1.0 / (o.r * R * H0 * H1);
        const double per_R = inverse * (o.r * H0 * H1), per_H0 = inverse * (o.r * R * H1),
                     per_H1 = inverse * (o.r * R * H0);
        const double rho = o.r * per_R, h_rho_slope = 0.5 * r0 * rho * per_R;
        const double rho_slope = 0.5 * r0 * per_R * inverse * (H0 * H1);
        const double change = 0.5 * (r0 - o.r) * per_R * rho_slope;  // of h_rho_slope
        const auto second = [&](double s, double per_H) {
            return per_H * (per_H * (s * (rho_slope - 2.0 * rho * per_H) - h_rho_slope) + change);
        };
        return 2.0 * (s0 * per_H0) * (s0 * per_H0) * per_H0 + in.at_q0 * second(s0, per_H0) +
               (in.at_q1 + in.at_q1_squared * o.q1) * second(s1, per_H1) +
               in.at_q1_squared * o.q1_slope * o.q1_slope;
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

    /// The elastic force depends on all contacts of both grains: see pressure_block.hpp.
    static SOFTGRAIN_INLINE ContactAnswer contact(const ContactInput& c, double damping) {
        const double k_n = std::abs(Mollon2022::stiffness(c.E, c.length, c.delta));
        return {0.0, damping * std::sqrt(k_n * c.mass) * c.rate / c.length, k_n};
    }
    /// Energy of one grain's contacts, per reference area [N/m].
    static SOFTGRAIN_INLINE double contact_energy(double plane_E, double J, const Sums& sum) {
        return (2.0 / 3.0) * plane_E * J * sum.local;
    }
};

}  // namespace softgrain::sdem
