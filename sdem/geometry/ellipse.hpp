#pragma once
// A deformed grain: the ellipse x = c + F X over the reference ellipse of half axes a, b (a disc if equal).
#include <cmath>

#include "common/vec.hpp"

namespace softgrain::sdem {

/// Ellipse with its unit frame: boundary points are center + axes u, |u| = 1.
struct Ellipse {
    Vec2 center;      ///< [m]
    Mat2 axes;        ///< A = F diag(a, b) [m]
    Mat2 inverse;     ///< A^-1 [1/m]
    double det;       ///< det A [m^2]; the area is pi det
    double radius;    ///< sqrt(a b) [m], undeformed
    double bounding;  ///< largest half axis [m]
};

/// F must have det F > 0.
inline Ellipse make_ellipse(const Vec2& center, const Mat2& F, const Vec2& half_axes) {
    const double a = half_axes.x() * F(0, 0), b = half_axes.y() * F(0, 1);
    const double c = half_axes.x() * F(1, 0), d = half_axes.y() * F(1, 1);
    const double det = a * d - b * c;
    const double inv = 1.0 / det;
    Ellipse e;
    e.center = center;
    e.axes << a, b, c, d;
    e.inverse << d * inv, -b * inv, -c * inv, a * inv;
    e.det = det;
    e.radius = std::sqrt(half_axes.x() * half_axes.y());
    e.bounding = 0.5 * (std::sqrt((a + d) * (a + d) + (c - b) * (c - b)) +
                        std::sqrt((a - d) * (a - d) + (c + b) * (c + b)));
    return e;
}

/// A deformed disc.
inline Ellipse make_ellipse(const Vec2& center, const Mat2& F, double radius) {
    Ellipse e = make_ellipse(center, F, Vec2{radius, radius});
    e.radius = radius;
    return e;
}

}  // namespace softgrain::sdem
