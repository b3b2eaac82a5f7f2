#pragma once
// A grain's true shape: its ellipse cut by all its chords. Overlapping caps are counted once.
#include <span>
#include <vector>

#include "sdem/geometry/ellipse.hpp"

namespace softgrain::sdem {

/// A straight cut in the ellipse's unit frame: what stays has direction . u <= distance.
struct Cut {
    Vec2 direction;   ///< unit, outward
    double distance;  ///< cos psi, -1 to 1
};

/// The cut whose chord has the physical outward normal `normal` and goes through `point`.
Cut cut_of(const Ellipse& e, const Vec2& normal, const Vec2& point);

/// Area left [m^2]: arcs and straight edges summed in closed form.
double clipped_area(const Ellipse& e, std::span<const Cut> cuts);

/// Appends the closed outline, counter-clockwise: `nodes` nodes on the whole ellipse, those cut away replaced
/// by the chords' straight edges with their exact end points.
void append_clipped_outline(const Ellipse& e, std::span<const Cut> cuts, int nodes,
                            std::vector<Vec2>& outline);

}  // namespace softgrain::sdem
