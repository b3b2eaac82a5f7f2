#pragma once
// Uniform quadratic B-splines.
#include <array>

namespace softgrain::mpm {

/// The three splines that are not zero on a knot span, at t in [0, 1], and their derivatives by t.
struct SplineSpan {
    std::array<double, 3> value, slope;
    static constexpr std::array<double, 3> curvature{1.0, -2.0, 1.0};
};

constexpr SplineSpan spline_span(double t) {
    return {{0.5 * (1.0 - t) * (1.0 - t), 0.5 + t * (1.0 - t), 0.5 * t * t}, {t - 1.0, 1.0 - 2.0 * t, t}};
}

}  // namespace softgrain::mpm
