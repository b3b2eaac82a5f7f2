#include "app/bench/scaling/tiles.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/tiled.hpp"

namespace softgrain::bench {

int copies_of(int grains) {
    for (int side = 1; side * side <= grains; ++side)
        if (grains % (side * side) == 0 && grains / (side * side) <= largest_cell) return side;
    throw InputError(fmt::format(
        "{} grains: must be at most {} times the square of a whole number, as copies of a cell are made",
        grains, largest_cell));
}

Packing tiled_packing(const Scenario& scenario, int grains) {
    const int side = copies_of(grains);
    Scenario cell = scenario;
    cell.packing.count = grains / (side * side);
    cell.box = {};
    Packing jammed = make_packing(cell);
    for (Vec2& center : jammed.center) center *= 1.0 - squeeze;
    for (double& wall : jammed.box.position) wall *= 1.0 - squeeze;
    return tiled(jammed, side);
}

}  // namespace softgrain::bench
