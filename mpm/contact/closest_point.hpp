#pragma once
// Where a point lies beside a closed quadratic B-spline curve.
#include <optional>
#include <span>

#include "common/vec.hpp"

namespace softgrain::mpm {

/// The nearest place on a curve and how the curve runs there.
struct CurvePlace {
    int span;          ///< of control points span, span + 1, span + 2 (modulo their number)
    double t;          ///< in the span, 0 to 1
    double gap;        ///< signed, negative inside
    Vec2 normal;       ///< unit, outward of a counter-clockwise curve
    Vec2 tangent;      ///< unit
    double speed;      ///< |dc/dt|
    double curvature;  ///< n . d2c/dt2, negative where the curve is convex
};

/// control [n >= 3] counter-clockwise.
std::size_t nearest_control(std::span<const Vec2> control, const Vec2& p);
/// The same for a point near one whose nearest control is known: goes along the curve as long as it comes
/// nearer, and looks everywhere only if the point turns out to lie deep inside.
std::size_t nearest_control(std::span<const Vec2> control, const Vec2& p, std::size_t known);

/// Whether p lies farther out than `gap`, as far as its nearest control point tells.
bool is_far_outside(std::span<const Vec2> control, const Vec2& p, std::size_t nearest, double gap);

/// Nearest place of the curve to p, started at the nearest control point.
CurvePlace closest_place(std::span<const Vec2> control, const Vec2& p, std::size_t nearest);
CurvePlace closest_place(std::span<const Vec2> control, const Vec2& p);

}  // namespace softgrain::mpm
