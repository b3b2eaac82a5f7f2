#pragma once
// Stress of the sample, from the walls and from the contacts. Compression positive [N/m].
#include "common/observables/observable.hpp"

namespace softgrain {

/// Wall reaction / wall length: component 0 is xx (left and right), 1 is yy (bottom and top).
Vec2 wall_stress(const std::array<Vec2, 4>& wall_force, const Box& box);

/// Love-Weber: (1/A) sum of force (x) branch over all contacts, walls included.
Mat2 love_weber_stress(const GrainView& view);

/// Mean net contact force on a grain / mean normal force of a contact; 0 without contacts.
double unbalanced_force(const GrainView& view);

}  // namespace softgrain
