#pragma once
// A disc of radius 1 on its own background grid: what every grain of one resolution shares, computed once.
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain::mpm {

/// Rows of shape functions: each row lists nodes and their values.
struct ShapeRows {
    std::vector<int> start{0};  ///< [rows + 1]
    std::vector<int> node;      ///< ascending in a row
    std::vector<double> value;

    std::size_t size() const { return start.size() - 1; }
    std::span<const int> nodes(std::size_t row) const {
        return {node.data() + start[row], static_cast<std::size_t>(start[row + 1] - start[row])};
    }
    std::span<const double> values(std::size_t row) const {
        return {value.data() + start[row], static_cast<std::size_t>(start[row + 1] - start[row])};
    }
    /// sum N_i q_i of a row.
    Vec2 at(std::size_t row, std::span<const Vec2> q) const {
        Vec2 x = Vec2::Zero();
        for (int k = start[row]; k < start[row + 1]; ++k)
            x += value[static_cast<std::size_t>(k)] *
                 q[static_cast<std::size_t>(node[static_cast<std::size_t>(k)])];
        return x;
    }
};

/// A grid cell: its nodes and its material points. Gradients [point][node].
struct Cell {
    int first_node, nodes;    ///< in cell_node
    int first_point, points;  ///< in weight
    int first_gradient;       ///< in gradient: points * nodes of them
};

/// Quadratic B-splines on a square grid with the centre of the disc at a corner of cells. A spline that has
/// too little of its mass inside the disc is no unknown of its own: its coefficient is extrapolated from the
/// nearest 3 x 3 others, so that all quadratic fields remain exact and no node is loose (Hoellig, Reif and
/// Wipper 2001, extended B-splines). The unknowns are coefficients q of positions: x(X) = sum N_i(X) q_i.
///
/// Material points are Gauss points, 2 x 2 a cell; in cells that the circle cuts 2 x 2 in each piece between
/// the circle and the sides of the cell, so that the area is exact.
///
/// The surface is a closed quadratic B-spline curve through `controls` control points, which are themselves
/// rows of shape functions; it follows the circle to (pi/n)^4/8 for n control points.
struct ReferenceDisc {
    /// cells: across a radius, 2 to 64. Throws InputError else.
    explicit ReferenceDisc(int cells);

    int cells;  ///< across a radius
    double spacing() const { return 1.0 / cells; }
    std::size_t nodes() const { return coordinate.size(); }
    std::size_t points() const { return weight.size(); }

    std::vector<double> integral;  ///< [nodes] of N over the disc
    std::vector<Vec2> coordinate;  ///< [nodes] coefficients of the undeformed disc: X = sum N_i coordinate_i
    std::vector<Cell> cell;
    std::vector<int> cell_node;  ///< ascending in a cell
    std::vector<double> weight;  ///< [points] area
    std::vector<Vec2> gradient;  ///< of N by X
    ShapeRows at_points;         ///< [points] N

    ShapeRows control;  ///< of the surface curve
    ShapeRows surface;  ///< points at which contact is looked for, at equal angles
    /// Length of the circle that a surface point stands for.
    double surface_weight() const;
};

/// The disc of this resolution; made once and kept.
std::shared_ptr<const ReferenceDisc> reference_disc(int cells);

}  // namespace softgrain::mpm
