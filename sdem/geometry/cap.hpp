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
        // Even and odd terms apart: two short chains instead of a long one.
        const double z2 = z * z;
        double angle_even = angle(12), angle_odd = angle(11), area_even = area(12), area_odd = area(11);
        for (int n = 10; n >= 2; n -= 2) {
            angle_even = angle_even * z2 + angle(n);
            angle_odd = angle_odd * z2 + angle(n - 1);
            area_even = area_even * z2 + area(n);
            area_odd = area_odd * z2 + area(n - 1);
        }
        const double angle_sum = angle_odd + z * angle_even, area_sum = area_odd + z * area_even;
        return {q * (angle_sum * z + angle(0)), q * z * area_sum};
    }
    const double w = 1.0 + z, psi = 2.0 * std::atan(q);
    return {psi, psi - 2.0 * q * (1.0 - z) / (w * w)};
}

}  // namespace softgrain::sdem
