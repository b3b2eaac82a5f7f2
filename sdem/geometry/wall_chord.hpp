#pragma once
// Exact contact of an ellipse with a straight wall.
#include <cmath>

#include "sdem/geometry/cap.hpp"
#include "sdem/geometry/ellipse.hpp"

namespace softgrain::sdem {

/// Cap cut off by a wall; valid only if `touching`.
struct WallChord {
    bool touching = false;
    bool escaped = false;       ///< the whole ellipse is behind the wall
    Vec2 point = Vec2::Zero();  ///< mid-point of the chord [m]
    double length = 0.0;        ///< L_c [m]
    double depth = 0.0;         ///< largest distance beyond the wall [m]
    double cap = 0.0;           ///< area beyond the wall [m^2]
    double psi = 0.0;           ///< half opening angle in the unit frame
};

/// `inward` unit normal of the wall into the box, `distance` of the ellipse's centre from it [m].
inline WallChord wall_chord(const Ellipse& e, const Vec2& inward, double distance) {
    WallChord c;
    const Mat2& A = e.axes;
    const double sx = A(0, 0) * inward.x() + A(1, 0) * inward.y();
    const double sy = A(0, 1) * inward.x() + A(1, 1) * inward.y();
    const double support = std::sqrt(sx * sx + sy * sy);  // half width of the ellipse towards the wall
    c.depth = support - distance;
    c.touching = c.depth > 0.0;
    if (!c.touching) return c;
    c.escaped = distance <= -support;
    if (c.escaped) return c;
    const double cosine = distance / support;
    const double versine = c.depth / support;
    const double sine = std::sqrt(versine * (1.0 + cosine));
    const UnitCap cap = unit_cap(sine / (1.0 + cosine));
    c.length = 2.0 * sine * e.det / support;
    c.cap = e.det * cap.area;
    c.psi = cap.half_angle;
    const double scale = -cosine / support;
    c.point = Vec2{e.center.x() + scale * (A(0, 0) * sx + A(0, 1) * sy),
                   e.center.y() + scale * (A(1, 0) * sx + A(1, 1) * sy)};
    return c;
}

}  // namespace softgrain::sdem
