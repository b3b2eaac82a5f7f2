#pragma once
// Where things are drawn.
#include <vector>

#include "common/grain_view.hpp"

namespace softgrain {

/// [n] What to take off a grain's coordinates so that its centroid lies in the cell of least tilt; zero with
/// walls [m].
inline std::vector<Vec2> shift_into_cell(const GrainView& view) {
    std::vector<Vec2> shift(view.size(), Vec2::Zero());
    if (!view.box.periodic) return shift;
    const Box cell = view.box.reduced();
    for (std::size_t g = 0; g < view.size(); ++g) shift[g] = cell.image(cell.image_of(view.centroid[g]));
    return shift;
}

/// Foot of the perpendicular from `point` on the wall.
inline Vec2 foot_on_wall(const Box& box, int wall, Vec2 point) {
    point[wall_axis(wall)] = box.position[static_cast<std::size_t>(wall)];
    return point;
}

}  // namespace softgrain
