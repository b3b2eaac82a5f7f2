#include "common/observables/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace softgrain {

Shape polygon_shape(std::span<const Vec2> polygon) {
    Shape shape;
    if (polygon.size() < 3) return shape;
    // Moments of the triangles (origin, a, b), the origin on the outline to avoid cancellation.
    const Vec2 origin = polygon[0];
    Vec2 first = Vec2::Zero();
    Mat2 second = Mat2::Zero();
    double extent = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2 a = polygon[k] - origin;
        const Vec2 b = polygon[k + 1 < polygon.size() ? k + 1 : 0] - origin;
        const double twice = cross(a, b);
        shape.area += twice / 2.0;
        shape.perimeter += (b - a).norm();
        first += twice / 6.0 * (a + b);
        second += twice / 24.0 * ((a + b) * (a + b).transpose() + a * a.transpose() + b * b.transpose());
        extent = std::max(extent, a.squaredNorm());
    }
    if (std::abs(shape.area) <= std::numeric_limits<double>::epsilon() * extent) return shape;
    const Mat2 central = (second - first * first.transpose() / shape.area) / shape.area;
    const double mean = central.trace() / 2.0;
    const double half_difference = (central(0, 0) - central(1, 1)) / 2.0;
    const double radius = std::hypot(half_difference, central(0, 1));
    if (mean <= radius) return shape;
    shape.aspect_ratio = std::sqrt((mean + radius) / (mean - radius));
    if (radius > 0.0) shape.orientation = 0.5 * std::atan2(central(0, 1), half_difference);
    const double area = std::abs(shape.area);
    shape.asphericity = std::max(0.0, 4.0 * std::numbers::pi * mean / area - 1.0);
    shape.circularity = 4.0 * std::numbers::pi * area / (shape.perimeter * shape.perimeter);
    return shape;
}

std::vector<Shape> grain_shapes(const GrainView& view) {
    std::vector<Shape> shapes;
    for (std::size_t g = 0; g + 1 < view.outline_offset.size(); ++g) {
        const auto first = static_cast<std::size_t>(view.outline_offset[g]);
        const auto last = static_cast<std::size_t>(view.outline_offset[g + 1]);
        shapes.push_back(polygon_shape(view.outline_point.subspan(first, last - first)));
    }
    return shapes;
}

}  // namespace softgrain
