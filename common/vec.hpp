#pragma once
// Two-dimensional vectors and tensors used by every method.
#include <Eigen/Core>
#include <Eigen/LU>

namespace softgrain {

using Vec2 = Eigen::Vector2d;
using Mat2 = Eigen::Matrix2d;

/// z-component of a x b.
inline double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// a turned by +90 degrees.
inline Vec2 perpendicular(const Vec2& a) {
    return {-a.y(), a.x()};
}

}  // namespace softgrain
