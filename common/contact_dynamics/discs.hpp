#pragma once
// What the contact solver reads and writes: rigid discs as arrays.
#include <span>

#include "common/vec.hpp"

namespace softgrain {

/// n rigid discs. Discs of one group are frictionless with each other; different groups may rub.
struct Discs {
    std::span<const Vec2> x;         ///< [n] [m]
    std::span<const double> radius;  ///< [n] [m]
    std::span<const double> mass;    ///< [n] [kg]
    std::span<const int> group;      ///< [n] 0, 1, ... in any order
    std::span<Vec2> v;               ///< [n] [m/s], changed
    /// [n] angular velocity x radius [m/s], changed; may be empty without friction.
    std::span<double> rim_speed;
};

}  // namespace softgrain
