#pragma once
// A simple polygon as triangles, for graphics that only know triangles.
#include <array>
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain {

/// Ear clipping; corners by index into `polygon`, either winding. A polygon that crosses itself gives
/// triangles that cover it roughly.
std::vector<std::array<int, 3>> triangulate(std::span<const Vec2> polygon);

}  // namespace softgrain
