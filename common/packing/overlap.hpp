#pragma once
// How far two undeformed grains, discs or ellipses, lie within one another.
#include <cstddef>

#include "common/packing/packing.hpp"

namespace softgrain {

/// The factor by which both grains, about their centres, would have to be scaled to touch from outside: below
/// 1 if they overlap. Perram and Wertheim 1985, J. Comput. Phys. 58, 409. `shape_i` as Packing::shape_of,
/// `branch` from i to j [m].
double touching_scale(const Mat2& shape_i, const Mat2& shape_j, const Vec2& branch);

/// 1 - touching_scale, of discs (r_i + r_j - distance) / (r_i + r_j), of clumps the largest of their discs.
/// By the nearest image in a periodic box.
double relative_overlap(const Packing& packing, std::size_t i, std::size_t j);

}  // namespace softgrain
