#pragma once
// Stress of the sample, from the walls and from the contacts. Compression positive [N/m].
#include "common/observables/observable.hpp"

namespace softgrain {

/// Wall reaction / wall length, mean of opposite walls: component 0 is xx (left and right), 1 is yy (bottom
/// and top). Gravity makes the two differ by the weight.
Vec2 wall_stress(const std::array<Vec2, 4>& wall_force, const Box& box);

/// Stress of the sample from its boundary: of the walls, xy from their tangential forces, or of a periodic
/// cell. Symmetric part. `wall_force` and `cell_stress` as the solver gives them.
Mat2 boundary_stress(const std::array<Vec2, 4>& wall_force, const Mat2& cell_stress, const Box& box);

/// From grain i to grain j, by the nearest image of a periodic cell, or from grain i to the contact point at
/// a wall or a driven grain [m].
Vec2 branch(const GrainView& view, const GrainContact& contact);

/// Love-Weber: -(1/A) sum of the force on i (x) branch over all contacts of free grains, walls included. A
/// weight acts on the centroid and adds nothing.
Mat2 love_weber_stress(const GrainView& view);

/// Mean net force on a grain, its weight included, / mean force of a contact, or mean weight if that is
/// larger: 0 at rest, 1 in free fall, 0 without any force.
double unbalanced_force(const GrainView& view);

}  // namespace softgrain
