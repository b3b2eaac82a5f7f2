#pragma once
// Circular segment of the unit circle, half opening angle psi, written in q = tan(psi/2).
#include <cmath>

#include "common/simd.hpp"

namespace softgrain::sdem {

struct UnitCap {
    double half_angle;  ///< psi
    double area;        ///< psi - sin(psi) cos(psi)
};

/// area / q in y4 = 4 sin^2(psi/2) = 4 q^2 / (1 + q^2), up to largest_y4 (psi = 75 degrees); relative error
/// of the polynomial 1e-16. It interpolates at Chebyshev's nodes; the nearest singularity is (4 - y4)^(3/2).
constexpr double largest_y4 = 1.5;
SOFTGRAIN_INLINE double cap_series(double y4) {
    // Even and odd powers apart: two short chains instead of a long one.
    const double x = y4 * y4;
    double even = -2.778903440759896e-10;
    even = even * x - 7.514746495423273e-09;
    even = even * x - 3.002360123607423e-08;
    even = even * x - 1.3935429522961682e-07;
    even = even * x - 2.7787384339136243e-06;
    even = even * x - 7.215022667267587e-05;
    even = even * x - 0.002380952381730921;
    even = even * x + 1.3333333333333333;
    double odd = 1.9183142946809415e-09;
    odd = odd * x + 1.5011719693931787e-08;
    odd = odd * x - 1.524276666651538e-10;
    odd = odd * x - 5.612400472695596e-07;
    odd = odd * x - 1.3874071012159108e-05;
    odd = odd * x - 0.0003968253816404794;
    odd = odd * x - 0.26666666666665095;
    return y4 * (even + y4 * odd);
}

/// Relative accuracy 1e-14 for every q >= 0.
inline UnitCap unit_cap(double q) {
    const double z = q * q, w = 1.0 + z;
    const double half_sine = q / w;  // sin(psi) / 2
    const double sine_cosine = 2.0 * half_sine * ((1.0 - z) / w);
    const double y4 = 4.0 * q * half_sine;
    if (y4 > largest_y4) {
        const double psi = 2.0 * std::atan(q);
        return {psi, psi - sine_cosine};
    }
    const double area = q * cap_series(y4);
    return {area + sine_cosine, area};
}

}  // namespace softgrain::sdem
