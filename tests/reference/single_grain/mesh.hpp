#pragma once
// Quarter disc cut into nine-node quadrilaterals: a core block and two outer blocks.
#include <array>
#include <vector>

#include "common/vec.hpp"

namespace softgrain::reference {

/// Nodes of one element, row by row of its 3 x 3 lattice.
using Element = std::array<int, 9>;

struct Mesh {
    std::vector<Vec2> nodes;
    std::vector<Element> elements;
    std::vector<int>
        outline;  ///< nodes on the arc from the x axis to the y axis, corner and mid-edge in turn
    std::vector<int> on_x_axis;  ///< nodes with y = 0
    std::vector<int> on_y_axis;  ///< nodes with x = 0
};

/// Quarter of a disc of this radius, 3 n^2 elements, 2 n of them along the arc, finer towards both axes.
Mesh quarter_disc(double radius, int n);

}  // namespace softgrain::reference
