#pragma once
// Circular segment of the unit circle, half opening angle psi, written in q = tan(psi/2).
#include <cmath>

namespace softgrain::sdem {

/// psi - sin(psi) cos(psi), the segment's area. Relative accuracy 1e-14 for every q >= 0.
///
/// Series: 2 atan q - 2 q (1 - q^2)/(1 + q^2)^2 = 2 sum_n (-1)^n q^(2n+1) [1/(2n+1) - (2n+1)]; the n = 0 term
/// vanishes, so nothing cancels for small caps.
inline double unit_cap_area(double q) {
    const double z = q * q;
    if (z < 0.04) {
        constexpr auto coefficient = [](int n) {
            const double odd = 2.0 * n + 1.0;
            return (n % 2 == 0 ? 2.0 : -2.0) * (1.0 / odd - odd);
        };
        double sum = coefficient(12);
        for (int n = 11; n >= 1; --n) sum = sum * z + coefficient(n);
        return q * z * sum;
    }
    const double w = 1.0 + z;
    return 2.0 * std::atan(q) - 2.0 * q * (1.0 - z) / (w * w);
}

}  // namespace softgrain::sdem
