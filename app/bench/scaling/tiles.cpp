#include "app/bench/scaling/tiles.hpp"

#include <fmt/format.h>

#include "common/errors.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain::bench {

int copies_of(int grains) {
    for (int side = 1; side * side <= grains; ++side)
        if (grains % (side * side) == 0 && grains / (side * side) <= largest_cell) return side;
    throw InputError(fmt::format(
        "{} grains: must be at most {} times the square of a whole number, as copies of a cell are made",
        grains, largest_cell));
}

Packing tiled_between_walls(const Packing& cell, int side) {
    Packing many;
    many.box = cell.box;
    many.box.position[1] = cell.box.position[0] + side * cell.box.width();
    many.box.position[3] = cell.box.position[2] + side * cell.box.height();
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            for (std::size_t i = 0; i < cell.size(); ++i) {
                many.center.push_back(cell.center[i] + cell.box.image(x, y));
                many.radius.push_back(cell.radius[i]);
            }
    return many;
}

Packing tiled_packing(const Scenario& scenario, int grains) {
    const int side = copies_of(grains);
    Scenario cell = scenario;
    cell.packing.count = grains / (side * side);
    cell.box = {};
    Packing jammed = make_packing(cell);
    for (Vec2& center : jammed.center) center *= 1.0 - squeeze;
    for (double& wall : jammed.box.position) wall *= 1.0 - squeeze;
    return tiled_between_walls(jammed, side);
}

}  // namespace softgrain::bench
