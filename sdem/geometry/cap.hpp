#pragma once
// Circular segment of the unit circle, half opening angle psi, written in q = tan(psi/2).
#include <cmath>

#include "common/simd.hpp"

namespace softgrain::sdem {

struct UnitCap {
    double half_angle;  ///< psi
    double area;        ///< psi - sin(psi) cos(psi)
};

/// area / (q y) for y = sin^2(psi/2) = q^2 / (1 + q^2) up to 1/2, a half disc; relative error of the
/// polynomial 3e-16. It interpolates at Chebyshev's nodes; (1 - y)^(3/2) is the nearest singularity.
SOFTGRAIN_INLINE double cap_series(double y) {
    // Even and odd powers apart: two short chains instead of a long one.
    const double x = y * y;
    double even = 7.229381159767219;
    even = even * x + 11.872872742593808;
    even = even * x + 3.993665590020584;
    even = even * x + 0.372448562995063;
    even = even * x - 0.019252677483263623;
    even = even * x - 0.0453545372459104;
    even = even * x - 0.07388144294817806;
    even = even * x - 0.15238095231980814;
    even = even * x + 5.333333333333334;
    double odd = -2.1042157813198292;
    odd = odd * x - 11.842033330287185;
    odd = odd * x - 8.166179920627583;
    odd = odd * x - 1.478222515645873;
    odd = odd * x - 0.1077232692175664;
    odd = odd * x - 0.038818516992148715;
    odd = odd * x - 0.05683829521245594;
    odd = odd * x - 0.1015873067701723;
    odd = odd * x - 4.266666666666952;
    return even + y * odd;
}

/// Relative accuracy 1e-14 for every q >= 0.
inline UnitCap unit_cap(double q) {
    const double z = q * q, w = 1.0 + z;
    const double half_sine = q / w;  // sin(psi) / 2
    const double sine_cosine = 2.0 * half_sine * ((1.0 - z) / w);
    if (z > 1.0) {
        const double psi = 2.0 * std::atan(q);
        return {psi, psi - sine_cosine};
    }
    const double y = q * half_sine;
    const double area = q * y * cap_series(y);
    return {area + sine_cosine, area};
}

}  // namespace softgrain::sdem
