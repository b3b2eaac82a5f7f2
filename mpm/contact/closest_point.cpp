#include "mpm/contact/closest_point.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {
namespace {

constexpr int most_steps = 30;
constexpr double small_step = 1e-13;
/// Share of |dc/dt|^2 below which the curvature may not bring the second derivative of the distance.
constexpr double least_convexity = 0.2;
/// How far a curve may bulge over the line along a control point [distance of its neighbours].
constexpr double bulge = 0.25;

}  // namespace

std::size_t nearest_control(std::span<const Vec2> control, const Vec2& p) {
    std::size_t nearest = 0;
    double least = (control[0] - p).squaredNorm();
    for (std::size_t k = 1; k < control.size(); ++k) {
        const double distance = (control[k] - p).squaredNorm();
        if (distance < least) {
            least = distance;
            nearest = k;
        }
    }
    return nearest;
}

std::size_t nearest_control(std::span<const Vec2> control, const Vec2& p, std::size_t known) {
    const std::size_t n = control.size();
    double least = (control[known] - p).squaredNorm();
    for (const std::size_t way : {std::size_t{1}, n - 1})
        for (std::size_t next = (known + way) % n;; next = (known + way) % n) {
            const double distance = (control[next] - p).squaredNorm();
            if (distance >= least) break;
            least = distance;
            known = next;
        }
    const Vec2 along = control[(known + 1) % n] - control[(known + n - 1) % n], away = p - control[known];
    const bool deep = cross(away, along) < 0.0 && least > along.squaredNorm();
    return deep ? nearest_control(control, p) : known;
}

bool is_far_outside(std::span<const Vec2> control, const Vec2& p, std::size_t nearest, double gap) {
    const std::size_t n = control.size();
    const Vec2 along = control[(nearest + 1) % n] - control[(nearest + n - 1) % n];
    const double size = along.norm();
    return cross(p - control[nearest], along) > (gap + bulge * size) * size;
}

CurvePlace closest_place(std::span<const Vec2> control, const Vec2& p) {
    return closest_place(control, p, nearest_control(control, p));
}

CurvePlace closest_place(std::span<const Vec2> control, const Vec2& p, std::size_t nearest) {
    const auto n = static_cast<int>(control.size());
    int span = static_cast<int>(nearest) - 1;
    double t = 0.5;
    for (int step = 0;; ++step) {
        span = (span % n + n) % n;
        const Vec2& a = control[static_cast<std::size_t>(span)];
        const Vec2& b = control[static_cast<std::size_t>((span + 1) % n)];
        const Vec2& c = control[static_cast<std::size_t>((span + 2) % n)];
        const SplineSpan s = spline_span(t);
        const Vec2 place = s.value[0] * a + s.value[1] * b + s.value[2] * c;
        const Vec2 slope = s.slope[0] * a + s.slope[1] * b + s.slope[2] * c;
        const Vec2 bend = a - 2.0 * b + c;
        const Vec2 w = p - place;
        const double squared = slope.squaredNorm();
        const double change =
            std::clamp(slope.dot(w) / std::max(squared - bend.dot(w), least_convexity * squared), -1.0, 1.0);
        if (std::abs(change) < small_step || step == most_steps) {
            const double speed = std::sqrt(squared);
            const Vec2 tangent = slope / speed;
            const Vec2 normal{tangent.y(), -tangent.x()};
            return {span, t, w.dot(normal), normal, tangent, speed, bend.dot(normal)};
        }
        t += change;
        const double whole = std::floor(t);
        t -= whole;
        span += static_cast<int>(whole);
    }
}

}  // namespace softgrain::mpm
