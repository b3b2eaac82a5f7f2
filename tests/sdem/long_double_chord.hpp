#pragma once
// The chord of two ellipses by scanning and bisection in long double: slow, and shares no code with sdem/.
#include <cmath>
#include <numbers>
#include <vector>

#include "sdem/geometry/ellipse.hpp"

namespace softgrain::sdem::test {

using Real = long double;
inline constexpr Real pi_l = std::numbers::pi_v<Real>;

struct Point {
    Real x, y;
};

struct LongEllipse {
    Point c;
    Real a, b, d, e;  // axes, row by row

    explicit LongEllipse(const Ellipse& from)
        : c{from.center.x(), from.center.y()},
          a(from.axes(0, 0)),
          b(from.axes(0, 1)),
          d(from.axes(1, 0)),
          e(from.axes(1, 1)) {}
    Real det() const { return a * e - b * d; }
    Point at(Real angle) const {
        const Real u = std::cos(angle), v = std::sin(angle);
        return {c.x + a * u + b * v, c.y + d * u + e * v};
    }
    /// Unit frame coordinates.
    Point unit(Point p) const {
        const Real x = p.x - c.x, y = p.y - c.y;
        return {(e * x - b * y) / det(), (a * y - d * x) / det()};
    }
    Real level(Point p) const {
        const Point u = unit(p);
        return (u.x * u.x + u.y * u.y) - 1;
    }
    Real support(Real nx, Real ny) const { return std::hypot(a * nx + d * ny, b * nx + e * ny); }
};

struct LongChord {
    int crossings = 0;
    Point p{}, q{};
    Real length = 0, nx = 0, ny = 0, depth_i = 0, depth_j = 0, cap_i = 0, cap_j = 0;
};

/// Angle on j's outline where it is deepest inside i, and the level there.
inline Real deepest_angle(const LongEllipse& i, const LongEllipse& j) {
    const int samples = 180;
    Real best = 0, lowest = 1e30L;
    for (int k = 0; k < samples; ++k) {
        const Real angle = 2 * pi_l * k / samples;
        const Real g = i.level(j.at(angle));
        if (g < lowest) lowest = g, best = angle;
    }
    Real low = best - 2 * pi_l / samples, high = best + 2 * pi_l / samples;
    const Real golden = (std::sqrt(5.0L) - 1) / 2;
    for (int k = 0; k < 60; ++k) {
        const Real m1 = high - golden * (high - low), m2 = low + golden * (high - low);
        if (i.level(j.at(m1)) < i.level(j.at(m2)))
            high = m2;
        else
            low = m1;
    }
    return (low + high) / 2;
}

/// Area of the ellipse beyond its chord between two points, on the side of (nx, ny).
inline Real cap_area(const LongEllipse& e, Point p, Point q, Real nx, Real ny) {
    const Point u = e.unit(p), v = e.unit(q);
    const Real half = std::hypot(v.x - u.x, v.y - u.y) / 2;
    const Real side = nx * ((p.x + q.x) / 2 - e.c.x) + ny * ((p.y + q.y) / 2 - e.c.y);
    const Real psi =
        side >= 0 ? std::asin(std::min<Real>(half, 1)) : pi_l - std::asin(std::min<Real>(half, 1));
    return e.det() * (psi - std::sin(2 * psi) / 2);
}

/// Two-point contacts only; crossings tells how many there are.
inline LongChord long_chord(const Ellipse& from_i, const Ellipse& from_j) {
    const LongEllipse i(from_i), j(from_j);
    const auto g = [&](Real angle) { return i.level(j.at(angle)); };
    LongChord out;
    const Real start = deepest_angle(i, j);
    if (g(start) >= 0) return out;
    const int samples = 1024;
    std::vector<Real> root;
    Real before = g(start);
    for (int k = 1; k <= samples; ++k) {
        const Real now = g(start + 2 * pi_l * k / samples);
        if ((now < 0) != (before < 0)) {
            Real low = start + 2 * pi_l * (k - 1) / samples, high = start + 2 * pi_l * k / samples;
            for (int it = 0; it < 70; ++it) {
                const Real mid = (low + high) / 2;
                ((g(mid) < 0) == (before < 0) ? low : high) = mid;
            }
            root.push_back((low + high) / 2);
        }
        before = now;
    }
    out.crossings = static_cast<int>(root.size());
    if (root.size() != 2) return out;
    out.p = j.at(root[1]);  // counter-clockwise over the cap: from the last root to the first
    out.q = j.at(root[0]);
    out.length = std::hypot(out.q.x - out.p.x, out.q.y - out.p.y);
    out.nx = -(out.q.y - out.p.y) / out.length;
    out.ny = (out.q.x - out.p.x) / out.length;
    const auto offset = [&](const LongEllipse& e) {
        return out.nx * ((out.p.x + out.q.x) / 2 - e.c.x) + out.ny * ((out.p.y + out.q.y) / 2 - e.c.y);
    };
    out.depth_i = i.support(out.nx, out.ny) - offset(i);
    out.depth_j = j.support(out.nx, out.ny) + offset(j);
    out.cap_i = cap_area(i, out.p, out.q, out.nx, out.ny);
    out.cap_j = cap_area(j, out.p, out.q, -out.nx, -out.ny);
    return out;
}

}  // namespace softgrain::sdem::test
