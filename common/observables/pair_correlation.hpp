#pragma once
// How the density of centres depends on the distance from a centre.
#include <span>

#include "common/box.hpp"
#include "common/observables/histogram.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// g(r) for r up to `reach` by bins of `bin` [m]: 1 for centres without order. Between walls pairs count by
/// how much of the box can hold such a pair (Ohser's translation correction, Stoyan & Stoyan 1994, Fractals,
/// Random Shapes and Point Fields, 15.4), in the rectangle around the centres. `reach` is cut to half of the
/// smaller side of that rectangle, or of the spacing of a cell. Empty for less than two centres.
Histogram pair_correlation(std::span<const Vec2> position, const Box& box, double bin, double reach);

}  // namespace softgrain
