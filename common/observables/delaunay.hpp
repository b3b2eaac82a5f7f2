#pragma once
// Delaunay triangulation in exact arithmetic.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain {

/// Corners of a triangle, counter-clockwise, the smallest first.
using Triangle = std::array<int, 3>;

/// Points on a grid of whole numbers, on which the geometry is exact.
struct GridPoint {
    std::int64_t x, y;
};
/// Largest difference between two coordinates of grid points.
inline constexpr std::int64_t grid_extent = std::int64_t{1} << 30;

/// Bowyer 1981 and Watson 1981 (Comput. J. 24, 162 and 167), with a point at infinity beyond the hull.
/// Sorted; of points that are equal only one is used; empty if all lie on a line. Of four points on a circle
/// either diagonal may be taken.
std::vector<Triangle> delaunay(const std::vector<GridPoint>& points);

/// Of points rounded to 2^-30 of the larger side of the rectangle around them.
std::vector<Triangle> delaunay(std::span<const Vec2> points);

}  // namespace softgrain
