#pragma once
// A 2x2 tensor of plain numbers, for loops over grains that the compiler turns into vector instructions. Free
// of Eigen, whose types depend on the instruction set (see cmake/simd.cmake).
#include <cmath>

namespace softgrain::sdem {

struct Tensor {
    double xx, xy, yx, yy;

    double det() const { return xx * yy - xy * yx; }
    double trace() const { return xx + yy; }
    double squared() const { return (xx * xx + yy * yy) + (xy * xy + yx * yx); }
    /// det F F^-T
    Tensor cofactor() const { return {yy, -yx, -xy, xx}; }
    /// The tensor whose product with a spin is F': it turns F without deforming it.
    Tensor turned() const { return {-yx, -yy, xx, xy}; }
};

inline Tensor operator+(const Tensor& a, const Tensor& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}
inline Tensor operator-(const Tensor& a, const Tensor& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.yx - b.yx, a.yy - b.yy};
}
inline Tensor operator*(double s, const Tensor& a) {
    return {s * a.xx, s * a.xy, s * a.yx, s * a.yy};
}
inline Tensor operator*(const Tensor& a, const Tensor& b) {
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
}
inline double contraction(const Tensor& a, const Tensor& b) {
    return (a.xx * b.xx + a.yy * b.yy) + (a.xy * b.xy + a.yx * b.yx);
}

/// Rotation R of F = R U and tr U.
struct Polar {
    double cosine, sine;  ///< of the rotation angle
    double trace;         ///< tr U = 2 (1 + eps_iso)

    explicit Polar(const Tensor& F) {
        const double p = F.xx + F.yy, s = F.yx - F.xy;
        trace = std::sqrt(p * p + s * s);
        cosine = p / trace;
        sine = s / trace;
    }
    Tensor rotation() const { return {cosine, -sine, sine, cosine}; }
};

/// Half the difference of the two principal stretches: the paper's (eps_1 - eps_2)/2, >= 0.
inline double half_stretch_difference(const Tensor& F) {
    const double p = F.xx - F.yy, s = F.yx + F.xy;
    return 0.5 * std::sqrt(p * p + s * s);
}

/// Largest half axis of the deformed grain: the larger singular value of F diag(a, b) [m].
inline double reach_of(const Tensor& F, double a, double b) {
    const double p = a * F.xx + b * F.yy, q = a * F.yx - b * F.xy;
    const double r = a * F.xx - b * F.yy, s = a * F.yx + b * F.xy;
    return 0.5 * (std::sqrt(p * p + q * q) + std::sqrt(r * r + s * s));
}

}  // namespace softgrain::sdem
