#include "common/packing/tiled.hpp"

namespace softgrain {

Packing tiled(const Packing& cell, int side) {
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

}  // namespace softgrain
