#pragma once
// An order of points in which neighbours in space are neighbours in memory.
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain {

/// [n] indices of the points along a Z-order curve over cells of the given size [m].
std::vector<int> space_order(std::span<const Vec2> x, double cell);

}  // namespace softgrain
