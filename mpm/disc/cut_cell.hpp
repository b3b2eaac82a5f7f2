#pragma once
// Integration over the part of a rectangle that lies in the disc of radius 1.
#include <vector>

#include "common/vec.hpp"

namespace softgrain::mpm {

struct QuadraturePoint {
    Vec2 position;
    double weight;  ///< area
};

/// 2 x 2 Gauss points in each piece of the rectangle [low, high] between the circle and its sides; weights
/// sum to the covered area to rounding. Empty if nothing is covered.
std::vector<QuadraturePoint> quadrature_in_disc(const Vec2& low, const Vec2& high);

}  // namespace softgrain::mpm
