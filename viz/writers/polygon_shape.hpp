#pragma once
// Shape of a grain from its outline.
#include <span>

#include "common/vec.hpp"

namespace softgrain {

struct PolygonShape {
    double area;          ///< signed: positive if counter-clockwise [m^2]
    double aspect_ratio;  ///< >= 1: square root of the ratio of the principal second moments of area
    double orientation;   ///< of the long axis, -pi/2 to pi/2 [rad]
};

/// A polygon without area has aspect_ratio 1 and orientation 0.
PolygonShape polygon_shape(std::span<const Vec2> polygon);

}  // namespace softgrain
