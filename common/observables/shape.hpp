#pragma once
// Shape of a grain from its outline.
#include <span>

#include "common/grain_view.hpp"

namespace softgrain {

/// From the area and its second moments, which roughness hardly changes, but for the perimeter and with it
/// the circularity: 0.67 for a round aggregate of 100 discs, while its asphericity is 0.015.
struct Shape {
    double area = 0.0;          ///< signed: positive if counter-clockwise [m^2]
    double perimeter = 0.0;     ///< [m]
    double aspect_ratio = 1.0;  ///< >= 1: square root of the ratio of the principal second moments of area
    double orientation = 0.0;   ///< of the long axis, -pi/2 to pi/2 [rad]
    /// 2 pi J / A^2 - 1 >= 0 with the polar second moment of area J about the centroid: 0 for a disc only,
    /// (s + 1/s) / 2 - 1 for an ellipse of aspect ratio s, pi/3 - 1 for a square.
    double asphericity = 0.0;
    /// 4 pi A / perimeter^2, 0 to 1: 1 for a disc only.
    double circularity = 1.0;
};

/// A polygon without area has aspect ratio 1, orientation 0, asphericity 0 and circularity 1.
Shape polygon_shape(std::span<const Vec2> polygon);

/// [n] Shapes of all grains; empty if the view has no outlines.
std::vector<Shape> grain_shapes(const GrainView& view);

}  // namespace softgrain
