#pragma once
// A 2x2 tensor of plain numbers, for loops over grains that the compiler turns into vector instructions. Free
// of Eigen, whose types depend on the instruction set (see cmake/simd.cmake).
#include <cmath>

#include "common/simd.hpp"

namespace softgrain::sdem {

struct Tensor {
    double xx, xy, yx, yy;

    Tensor() = default;
    SOFTGRAIN_INLINE constexpr Tensor(double xx_, double xy_, double yx_, double yy_)
        : xx(xx_), xy(xy_), yx(yx_), yy(yy_) {}
    // Copied number by number: the copy of a whole struct keeps a loop from being vectorised.
    SOFTGRAIN_INLINE constexpr Tensor(const Tensor& t) : xx(t.xx), xy(t.xy), yx(t.yx), yy(t.yy) {}
    SOFTGRAIN_INLINE constexpr Tensor& operator=(const Tensor& t) {
        xx = t.xx;
        xy = t.xy;
        yx = t.yx;
        yy = t.yy;
        return *this;
    }

    SOFTGRAIN_INLINE double det() const { return xx * yy - xy * yx; }
    SOFTGRAIN_INLINE double trace() const { return xx + yy; }
    SOFTGRAIN_INLINE double squared() const { return (xx * xx + yy * yy) + (xy * xy + yx * yx); }
    /// det F F^-T
    SOFTGRAIN_INLINE Tensor cofactor() const { return {yy, -yx, -xy, xx}; }
    /// The tensor whose product with a spin is F': it turns F without deforming it.
    SOFTGRAIN_INLINE Tensor turned() const { return {-yx, -yy, xx, xy}; }
};

SOFTGRAIN_INLINE Tensor operator+(const Tensor& a, const Tensor& b) {
    return {a.xx + b.xx, a.xy + b.xy, a.yx + b.yx, a.yy + b.yy};
}
SOFTGRAIN_INLINE Tensor operator-(const Tensor& a, const Tensor& b) {
    return {a.xx - b.xx, a.xy - b.xy, a.yx - b.yx, a.yy - b.yy};
}
SOFTGRAIN_INLINE Tensor operator*(double s, const Tensor& a) {
    return {s * a.xx, s * a.xy, s * a.yx, s * a.yy};
}
SOFTGRAIN_INLINE Tensor operator*(const Tensor& a, const Tensor& b) {
    return {a.xx * b.xx + a.xy * b.yx, a.xx * b.xy + a.xy * b.yy, a.yx * b.xx + a.yy * b.yx,
            a.yx * b.xy + a.yy * b.yy};
}
SOFTGRAIN_INLINE double contraction(const Tensor& a, const Tensor& b) {
    return (a.xx * b.xx + a.yy * b.yy) + (a.xy * b.xy + a.yx * b.yx);
}

/// Rotation R of F = R U and tr U.
struct Polar {
    double cosine, sine;  ///< of the rotation angle
    double trace;         ///< tr U = 2 (1 + eps_iso)

    SOFTGRAIN_INLINE explicit Polar(const Tensor& F) {
        const double p = F.xx + F.yy, s = F.yx - F.xy;
        trace = std::sqrt(p * p + s * s);
        cosine = p / trace;
        sine = s / trace;
    }
    SOFTGRAIN_INLINE Tensor rotation() const { return {cosine, -sine, sine, cosine}; }
};

/// Half the difference of the two principal stretches: the paper's (eps_1 - eps_2)/2, >= 0.
SOFTGRAIN_INLINE double half_stretch_difference(const Tensor& F) {
    const double p = F.xx - F.yy, s = F.yx + F.xy;
    return 0.5 * std::sqrt(p * p + s * s);
}

/// Largest half axis of the deformed grain: the larger singular value of F diag(a, b) [m].
SOFTGRAIN_INLINE double reach_of(const Tensor& F, double a, double b) {
    const double p = a * F.xx + b * F.yy, q = a * F.yx - b * F.xy;
    const double r = a * F.xx - b * F.yy, s = a * F.yx + b * F.xy;
    return 0.5 * (std::sqrt(p * p + q * q) + std::sqrt(r * r + s * s));
}

}  // namespace softgrain::sdem
