#pragma once
// The paper's contact detection: two outlines of N nodes each and a piecewise-linear intersection (Mollon
// 2022, Eq. 49-54). Kept as an independent check of chord.hpp and as the baseline its speed is compared with.
#include <vector>

#include "sdem/geometry/chord.hpp"

namespace softgrain::sdem {

/// Nodes of the outline at equal steps of the reference angle, counter-clockwise (Eq. 49, 50).
std::vector<Vec2> outline_nodes(const Ellipse& e, int nodes);

/// Contact of the two N-sided polygons; psi_i and psi_j stay zero. The paper takes 360 nodes.
/// Contacts in which no node of one grain lies in the other are missed.
Chord polygon_chord(const Ellipse& i, const Ellipse& j, int nodes = 360);

}  // namespace softgrain::sdem
