#pragma once
// Which nodes of a disc stiffness couples: the same for every grain of one resolution.
#include <span>
#include <vector>

#include "mpm/disc/reference_disc.hpp"

namespace softgrain::mpm {

/// Lower triangle by rows of nodes, 2 x 2 numbers in each place.
struct StiffnessPattern {
    explicit StiffnessPattern(const ReferenceDisc& disc);

    std::vector<int> start;   ///< [nodes + 1]
    std::vector<int> column;  ///< ascending in a row, the diagonal last
    /// Of each cell, for its nodes a >= b: the place of (a, b), at cell_start + a (a + 1) / 2 + b.
    std::vector<int> place;
    std::vector<int> cell_start;  ///< [cells]

    std::size_t size() const { return column.size(); }
};

}  // namespace softgrain::mpm
