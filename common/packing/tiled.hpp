#pragma once
// A packing of copies of a cell.
#include "common/packing/packing.hpp"

namespace softgrain {

/// `side` x `side` copies of the discs of a cell without tilt, periodic if it is.
Packing tiled(const Packing& cell, int side);

}  // namespace softgrain
