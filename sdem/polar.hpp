#pragma once
// Polar decomposition F = R U of a 2x2 matrix with det F > 0, in closed form.
#include <cmath>

#include "common/vec.hpp"

namespace softgrain::sdem {

/// Rotation of F and the trace of its stretch.
struct Polar {
    double cosine, sine;  ///< of the rotation angle
    double trace;         ///< tr U = 2 (1 + eps_iso)

    explicit Polar(const Mat2& F) {
        const double p = F(0, 0) + F(1, 1), s = F(1, 0) - F(0, 1);
        trace = std::sqrt(p * p + s * s);
        cosine = p / trace;
        sine = s / trace;
    }
    Mat2 rotation() const {
        Mat2 R;
        R << cosine, -sine, sine, cosine;
        return R;
    }
};

/// Half the difference of the two principal stretches: the paper's (eps_1 - eps_2)/2, >= 0.
inline double half_stretch_difference(const Mat2& F) {
    const double p = F(0, 0) - F(1, 1), s = F(1, 0) + F(0, 1);
    return 0.5 * std::sqrt(p * p + s * s);
}

}  // namespace softgrain::sdem
