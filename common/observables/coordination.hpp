#pragma once
// Who touches whom: coordination numbers with and without rattlers.
#include "common/grain_view.hpp"

namespace softgrain {

/// PHYSICS conventions: Z = 2 N_gg / N, N_gg pairs of grains in however many places they touch; a rattler has
/// fewer than 2 contacts (walls count), removed repeatedly. A driven grain counts as a wall.
struct Coordination {
    double all;               ///< 2 N_gg / N over all grains
    double without_rattlers;  ///< the same over grains that carry load; 0 if there are none
    double with_walls;        ///< (2 N_gg + N_gw) / N over all grains
    int rattlers;
};

Coordination coordination(const GrainView& view);

}  // namespace softgrain
