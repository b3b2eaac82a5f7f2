#pragma once
// The sample divided into triangles between grain centres: local strain and void ratio.
#include <array>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/observables/delaunay.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// A copy of a periodic cell: x times the first lattice vector and y times the second.
struct CellOffset {
    int x, y;
};

/// Delaunay triangles between grain centres. Bagi 1996, Mech. Mater. 22, 165: their strain is that of the
/// grains between which they lie, and its mean that of the boundary.
struct Tessellation {
    std::vector<Triangle> triangles;                 ///< counter-clockwise
    std::vector<std::array<CellOffset, 3>> offsets;  ///< [triangles] in a periodic cell, else empty

    /// Corners of a triangle, by the positions and the cell of any time since it was made [m].
    std::array<Vec2, 3> corners(std::size_t triangle, std::span<const Vec2> position, const Box& box) const;
};

/// Of all centres within their hull, or of the whole periodic cell (where positions may lie outside).
/// Triangles flatter than a billionth of their length are left out at the hull. Throws InputError if a
/// periodic cell has so few grains that one has neighbours further away than the next copy of the cell.
Tessellation tessellate(std::span<const Vec2> position, const Box& box);

/// Area, positive if counter-clockwise [m^2].
double triangle_area(const std::array<Vec2, 3>& corners);

/// [triangles] Deformation gradients dx/dX from a reference configuration (positions X and box) to another;
/// of periodic cells with positions that were not wrapped since. nan where the reference has no area.
std::vector<Mat2> local_gradients(const Tessellation& tessellation, std::span<const Vec2> reference,
                                  const Box& reference_box, std::span<const Vec2> position, const Box& box);
/// Their mean by reference area: that of the hull, or of the cell.
Mat2 mean_gradient(const Tessellation& tessellation, std::span<const Vec2> reference,
                   const Box& reference_box, std::span<const Vec2> position, const Box& box);

/// [triangles] Area of voids / area of grains, of discs of the undeformed areas [n] [m^2] with what of them
/// lies between the sides that meet at their centre. Below 0 where discs overlap by more than the voids.
std::vector<double> void_ratios(const Tessellation& tessellation, std::span<const Vec2> position,
                                const Box& box, std::span<const double> reference_area);

}  // namespace softgrain
