#include "viz/writers/polygon_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softgrain {

PolygonShape polygon_shape(std::span<const Vec2> polygon) {
    PolygonShape shape{0.0, 1.0, 0.0};
    if (polygon.size() < 3) return shape;
    // Moments of the triangles (origin, a, b), the origin on the outline to avoid cancellation.
    const Vec2 origin = polygon[0];
    Vec2 first = Vec2::Zero();
    Mat2 second = Mat2::Zero();
    double extent = 0.0;
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
        const Vec2 a = polygon[k] - origin;
        const Vec2 b = polygon[k + 1] - origin;
        const double twice = cross(a, b);
        shape.area += twice / 2.0;
        first += twice / 6.0 * (a + b);
        second += twice / 24.0 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
        extent = std::max({extent, a.squaredNorm(), b.squaredNorm()});
    }
    if (std::abs(shape.area) <= std::numeric_limits<double>::epsilon() * extent) return shape;
    const Mat2 central = (second - first * first.transpose() / shape.area) / shape.area;
    const double mean = central.trace() / 2.0;
    const double half_difference = (central(0, 0) - central(1, 1)) / 2.0;
    const double radius = std::hypot(half_difference, central(0, 1));
    if (mean <= radius) return shape;
    shape.aspect_ratio = std::sqrt((mean + radius) / (mean - radius));
    if (radius > 0.0) shape.orientation = 0.5 * std::atan2(central(0, 1), half_difference);
    return shape;
}

}  // namespace softgrain
