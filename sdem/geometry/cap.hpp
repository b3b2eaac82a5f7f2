#pragma once
// Circular segment of the unit circle, half opening angle psi, written in q = tan(psi/2).
#include <cmath>

namespace softgrain::sdem {

struct UnitCap {
    double half_angle;  ///< psi
    double area;        ///< psi - sin(psi) cos(psi)
};

/// Relative accuracy 1e-14 for every q >= 0.
///
/// Series: psi = 2 atan q = 2 sum_n (-1)^n q^(2n+1)/(2n+1), and sin(psi) cos(psi) = 2 q (1 - q^2)/(1 + q^2)^2
/// = 2 sum_n (-1)^n (2n+1) q^(2n+1); the n = 0 terms of the area cancel exactly.
inline UnitCap unit_cap(double q) {
    const double z = q * q;
    if (z < 0.04) {
        constexpr auto angle = [](int n) { return (n % 2 == 0 ? 2.0 : -2.0) / (2.0 * n + 1.0); };
        constexpr auto area = [](int n) {
            const double odd = 2.0 * n + 1.0;
            return (n % 2 == 0 ? 2.0 : -2.0) * (1.0 / odd - odd);
        };
        double angle_sum = angle(12), area_sum = area(12);
        for (int n = 11; n >= 1; --n) {
            angle_sum = angle_sum * z + angle(n);
            area_sum = area_sum * z + area(n);
        }
        return {q * (angle_sum * z + angle(0)), q * z * area_sum};
    }
    const double w = 1.0 + z, psi = 2.0 * std::atan(q);
    return {psi, psi - 2.0 * q * (1.0 - z) / (w * w)};
}

}  // namespace softgrain::sdem
