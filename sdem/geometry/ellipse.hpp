#pragma once
// A deformed disc: the ellipse x = c + F X, |X| <= R.
#include <cmath>

#include "common/vec.hpp"

namespace softgrain::sdem {

/// Ellipse with its unit frame: boundary points are center + axes u, |u| = 1.
struct Ellipse {
    Vec2 center;      ///< [m]
    Mat2 axes;        ///< A = R F [m]
    Mat2 inverse;     ///< A^-1 [1/m]
    double det;       ///< det A [m^2]; the area is pi det
    double radius;    ///< R [m], undeformed
    double bounding;  ///< largest half axis [m]
};

/// F must have det F > 0.
inline Ellipse make_ellipse(const Vec2& center, const Mat2& F, double radius) {
    const double a = radius * F(0, 0), b = radius * F(0, 1), c = radius * F(1, 0), d = radius * F(1, 1);
    const double det = a * d - b * c;
    const double inv = 1.0 / det;
    Ellipse e;
    e.center = center;
    e.axes << a, b, c, d;
    e.inverse << d * inv, -b * inv, -c * inv, a * inv;
    e.det = det;
    e.radius = radius;
    e.bounding = 0.5 * (std::sqrt((a + d) * (a + d) + (c - b) * (c - b)) +
                        std::sqrt((a - d) * (a - d) + (c + b) * (c + b)));
    return e;
}

}  // namespace softgrain::sdem
