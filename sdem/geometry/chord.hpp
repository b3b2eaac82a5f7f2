#pragma once
// Exact contact of two ellipses: the chord between the two points where their outlines cross.
//
// The larger grain becomes the unit circle: with B = A_i^-1 A_j and d = A_i^-1 (c_j - c_i), a point u of j's
// unit circle lies on i where g(u) = |d + B u|^2 - 1 = 0. Steps turn u by 2 atan(s/2) = rational, so no
// trigonometric function is called.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "sdem/geometry/cap.hpp"
#include "sdem/geometry/ellipse.hpp"

namespace softgrain::sdem {

enum class Overlap : std::uint8_t {
    none,
    chord,        ///< two intersections
    four_points,  ///< four intersections; the chord is that of the deepest pocket
    contained,    ///< one ellipse lies inside the other: no chord
    coincident,   ///< the centres coincide: no normal
};

/// Contact of grains i and j. Depths and areas are >= 0; only `overlap` is set if there is no chord.
struct Chord {
    Overlap overlap = Overlap::none;
    Vec2 point = Vec2::Zero();            ///< mid-point of the chord [m]
    Vec2 normal = Vec2::Zero();           ///< unit, out of i
    double length = 0.0;                  ///< L_c [m]
    double depth_i = 0.0, depth_j = 0.0;  ///< largest distance of each outline beyond the chord [m]
    double cap_i = 0.0, cap_j = 0.0;      ///< area of each ellipse beyond the chord [m^2]
    double psi_i = 0.0, psi_j = 0.0;      ///< half opening angle of each cap in its unit frame

    bool touching() const { return overlap == Overlap::chord || overlap == Overlap::four_points; }
};

/// What a contact remembers for the next call, in the unit frame of the smaller grain: the ends of its chord,
/// both the deepest direction while apart, zero for a cold start.
struct WarmStart {
    Vec2 a = Vec2::Zero(), b = Vec2::Zero();
};

namespace detail {

struct Unit {
    double x, y;
    Unit(double ux, double uy) : x(ux), y(uy) {}
    /// From a vector of length 1 but for rounding to float; the error left is the cube of that.
    explicit Unit(const Vec2& v) {
        const double excess = (v.x() * v.x() + v.y() * v.y()) - 1.0;
        const double scale = 1.0 - excess * (0.5 - 0.375 * excess);
        x = scale * v.x();
        y = scale * v.y();
    }
    Vec2 vec() const { return {x, y}; }
    /// Turned by 2 atan(num/den), with a single division.
    Unit turned(double num, double den) const {
        const double scale = 1.0 / (den * den + num * num);
        const double c = (den * den - num * num) * scale, s = 2.0 * num * den * scale;
        return {c * x - s * y, c * y + s * x};
    }
};
inline double cross(Unit a, Unit b) {
    return a.x * b.y - a.y * b.x;
}

/// j's outline seen from the unit circle of i.
struct Level {
    double dx, dy, xx, xy, yx, yy;  // d and B
    double bx, by, mxx, mxy, myy;   // B^T d and B^T B

    Level(const Ellipse& i, const Ellipse& j) {
        const double ex = j.center.x() - i.center.x(), ey = j.center.y() - i.center.y();
        const Mat2& p = i.inverse;
        const Mat2& a = j.axes;
        dx = p(0, 0) * ex + p(0, 1) * ey;
        dy = p(1, 0) * ex + p(1, 1) * ey;
        xx = p(0, 0) * a(0, 0) + p(0, 1) * a(1, 0);
        xy = p(0, 0) * a(0, 1) + p(0, 1) * a(1, 1);
        yx = p(1, 0) * a(0, 0) + p(1, 1) * a(1, 0);
        yy = p(1, 0) * a(0, 1) + p(1, 1) * a(1, 1);
        bx = xx * dx + yx * dy;
        by = xy * dx + yy * dy;
        mxx = xx * xx + yx * yx;
        mxy = xx * xy + yx * yy;
        myy = xy * xy + yy * yy;
    }
    double value(Unit u) const {
        const double wx = dx + xx * u.x + xy * u.y, wy = dy + yx * u.x + yy * u.y;
        return wx * wx + wy * wy - 1.0;
    }
    /// g' / 2 along the circle.
    double slope(Unit u) const {
        return by * u.x - bx * u.y + mxy * (u.x * u.x - u.y * u.y) + (myy - mxx) * u.x * u.y;
    }
    /// g'' / 2 along the circle.
    double curvature(Unit u) const {
        const double radial = mxx * u.x * u.x + 2.0 * mxy * u.x * u.y + myy * u.y * u.y;
        return mxx + myy - 2.0 * radial - bx * u.x - by * u.y;
    }
    /// True if g has one minimum and one maximum: |B^T d| beyond the spread of the eigenvalues of B^T B.
    bool has_one_minimum() const {
        const double difference = mxx - myy;
        return bx * bx + by * by > difference * difference + 4.0 * mxy * mxy;
    }
};

/// Newton on g' from u; false if it did not settle. Steps are at most about half a radian.
inline bool find_deepest(const Level& g, Unit& u) {
    constexpr double largest = 0.25, settled = 5e-5;  // half steps; the next error is the square
    for (int k = 0; k < 30; ++k) {
        const double slope = g.slope(u), curvature = g.curvature(u);
        const double limit = largest * std::abs(curvature);
        double num = -0.5 * slope, den = curvature;
        if (!(curvature > 0.0) || std::abs(num) > limit) num = std::copysign(largest, -slope), den = 1.0;
        u = u.turned(num, den);
        if (std::abs(num) < settled * den) return true;
    }
    return false;
}

/// One Halley step on g; returns whether it was small enough to be the last: the next error is its cube.
inline bool improve_root(const Level& g, Unit& u, double limit, double settled) {
    const double wx = g.dx + g.xx * u.x + g.xy * u.y, wy = g.dy + g.yx * u.x + g.yy * u.y;
    const double tx = g.xy * u.x - g.xx * u.y, ty = g.yy * u.x - g.yx * u.y;  // B t
    const double ux = wx - g.dx, uy = wy - g.dy;                              // B u
    const double value = wx * wx + wy * wy - 1.0;
    const double slope = wx * tx + wy * ty;                          // g'/2
    const double curvature = tx * tx + ty * ty - wx * ux - wy * uy;  // g''/2
    // s = -g g' / (g'^2 - g g''/2), turned by 2 atan(s/2).
    double num = -value * slope, den = 4.0 * slope * slope - value * curvature;
    if (!(std::abs(num) <= limit * std::abs(den))) num = std::copysign(limit, -value * slope), den = 1.0;
    u = u.turned(num, den);
    return std::abs(num) <= settled * std::abs(den);
}

/// Both roots from first guesses at sin(psi) = opening. Half steps are clamped to a quarter of it: without
/// that, tiny overlaps swap the two roots.
inline bool find_roots(const Level& g, Unit& a, Unit& b, double opening, int steps) {
    const double limit = 0.25 * opening, settled = 2e-5 * limit + 1e-15 / limit;
    for (int k = 0; k < steps; ++k) {
        const bool a_settled = improve_root(g, a, limit, settled),
                   b_settled = improve_root(g, b, limit, settled);
        if (a_settled && b_settled) return true;
    }
    return false;
}

/// Everything about the contact from its end points a, b on j's unit circle, counter-clockwise over the cap.
Chord finish(const Level& g, const Ellipse& i, const Ellipse& j, Unit a, Unit b, Overlap overlap);

/// Scan and bisection: any number of intersections, any strain. Slow.
Chord general_chord(const Level& g, const Ellipse& i, const Ellipse& j, WarmStart& warm);

inline Chord finish(const Level& g, const Ellipse& i, const Ellipse& j, Unit a, Unit b, Overlap overlap) {
    Chord c;
    const double tx = b.x - a.x, ty = b.y - a.y;  // chord in j's unit frame
    const double mx = 0.5 * (a.x + b.x), my = 0.5 * (a.y + b.y);
    const double two_h_j = std::sqrt(tx * tx + ty * ty);
    const double sx = g.xx * tx + g.xy * ty, sy = g.yx * tx + g.yy * ty;  // chord in i's
    const double px = g.dx + g.xx * mx + g.xy * my, py = g.dy + g.yx * mx + g.yy * my;
    const double two_h_i = std::sqrt(sx * sx + sy * sy);
    const Mat2& A = j.axes;
    const double cx = A(0, 0) * tx + A(0, 1) * ty, cy = A(1, 0) * tx + A(1, 1) * ty;
    c.length = std::sqrt(cx * cx + cy * cy);
    if (!(two_h_j > 0.0) || !(two_h_i > 0.0) || !(c.length > 0.0)) return Chord{};
    c.overlap = overlap;
    const double nx = -cy / c.length, ny = cx / c.length;
    c.normal = Vec2{nx, ny};
    c.point = Vec2{j.center.x() + A(0, 0) * mx + A(0, 1) * my, j.center.y() + A(1, 0) * mx + A(1, 1) * my};
    // cos psi = signed distance of the chord from each unit circle's centre.
    const double cos_j = (ty * mx - tx * my) / two_h_j;
    const double cos_i = (sx * py - sy * px) / two_h_i;
    const double h_j = 0.5 * two_h_j, h_i = 0.5 * two_h_i;
    const double tan_j = h_j / (1.0 + cos_j), tan_i = h_i / (1.0 + cos_i);
    const auto support = [&](const Mat2& axes) {
        const double x = axes(0, 0) * nx + axes(1, 0) * ny, y = axes(0, 1) * nx + axes(1, 1) * ny;
        return std::sqrt(x * x + y * y);
    };
    const UnitCap cap_i = unit_cap(tan_i), cap_j = unit_cap(tan_j);
    c.depth_j = support(j.axes) * h_j * tan_j;
    c.depth_i = support(i.axes) * h_i * tan_i;
    c.cap_j = j.det * cap_j.area;
    c.cap_i = i.det * cap_i.area;
    c.psi_j = cap_j.half_angle;
    c.psi_i = cap_i.half_angle;
    return c;
}

/// True if g has no root but a and b. About a, (1 + t^2)^2 g is a quartic in t, the tangent of half the angle
/// turned; with both roots divided out a quadratic is left, which must have none.
inline bool only_roots(const Level& g, Unit a, Unit b) {
    const double px = g.xx * a.x + g.xy * a.y, py = g.yx * a.x + g.yy * a.y;  // B a
    const double tx = g.xy * a.x - g.xx * a.y, ty = g.yy * a.x - g.yx * a.y;  // B turned a
    const double nx = g.dx + px, ny = g.dy + py, fx = g.dx - px, fy = g.dy - py;
    const double c2 = 4.0 * (tx * tx + ty * ty) + 2.0 * (nx * fx + ny * fy - 1.0);
    const double c3 = 4.0 * (tx * fx + ty * fy), c4 = fx * fx + fy * fy - 1.0;
    const double t = cross(a, b) / (1.0 + a.x * b.x + a.y * b.y);
    const double linear = c3 + c4 * t, constant = c2 + linear * t;
    return linear * linear < 4.0 * c4 * constant;
}

/// True if the centre of i is inside j and i is not larger than j: with no crossing, i is inside j.
inline bool inside(const Ellipse& i, const Ellipse& j) {
    return i.det <= j.det && (j.inverse * (i.center - j.center)).squaredNorm() < 1.0;
}

/// Where the search for the deepest direction starts.
inline Unit first_guess(const Level& g, const WarmStart& warm) {
    const Vec2 middle = warm.a + warm.b;
    const double norm = middle.norm();
    if (norm > 0.1) return {middle.x() / norm, middle.y() / norm};
    const double scale = -1.0 / std::sqrt(g.bx * g.bx + g.by * g.by);
    return {scale * g.bx, scale * g.by};
}

/// i is the unit circle.
inline Chord chord_from_circle(const Ellipse& i, const Ellipse& j, WarmStart& warm) {
    const Level g(i, j);
    const bool one_minimum = g.has_one_minimum();

    // From the last chord. If there are only these two roots the sign of g' tells which is which.
    Unit a(warm.a), b(warm.b);
    const double last = 0.5 * std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
    constexpr double smallest = 1e-3;
    if (last > smallest && find_roots(g, a, b, last, 3) && g.slope(a) < 0.0 && g.slope(b) > 0.0 &&
        (one_minimum || only_roots(g, a, b))) {
        warm = {a.vec(), b.vec()};
        return finish(g, i, j, a, b, Overlap::chord);
    }
    Unit u = first_guess(g, warm);
    if (!find_deepest(g, u)) return general_chord(g, i, j, warm);
    const double lowest = g.value(u);
    if (lowest >= 0.0 && !one_minimum) return general_chord(g, i, j, warm);  // another pocket may be deeper
    warm = {u.vec(), u.vec()};
    if (lowest >= 0.0) return inside(i, j) ? Chord{Overlap::contained} : Chord{};

    // g ~ g_min + g'' (1 - cos psi) near its minimum gives the first guess of both roots.
    const double versine = std::min(-0.5 * lowest / g.curvature(u), 1.9);
    const double cos0 = 1.0 - versine, sin0 = std::sqrt(versine * (2.0 - versine));
    a = {u.x * cos0 + u.y * sin0, u.y * cos0 - u.x * sin0};
    b = {u.x * cos0 - u.y * sin0, u.y * cos0 + u.x * sin0};
    if (!find_roots(g, a, b, sin0, 20) || !(cross(a, u) > 0.0) || !(cross(u, b) > 0.0) ||
        (!one_minimum && !only_roots(g, a, b)))
        return general_chord(g, i, j, warm);
    warm = {a.vec(), b.vec()};
    return finish(g, i, j, a, b, Overlap::chord);
}

}  // namespace detail

/// Contact of i and j. Never NaN, never endless.
inline Chord chord_of(const Ellipse& i, const Ellipse& j, WarmStart& warm) {
    if (i.radius >= j.radius) return detail::chord_from_circle(i, j, warm);
    Chord c = detail::chord_from_circle(j, i, warm);
    if (!c.touching()) return c;
    c.normal = -c.normal;
    std::swap(c.depth_i, c.depth_j);
    std::swap(c.cap_i, c.cap_j);
    std::swap(c.psi_i, c.psi_j);
    return c;
}

}  // namespace softgrain::sdem
