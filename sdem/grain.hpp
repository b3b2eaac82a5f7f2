#pragma once
// One grain's state. Free of Eigen, as tensor.hpp.
#include <numbers>

#include "sdem/tensor.hpp"

namespace softgrain::sdem {

/// One grain: the material point X of the reference ellipse (half axes a along x and b along y; a disc if
/// equal) is at c + F X. Two cache lines.
struct alignas(64) Grain {
    double x, y;    ///< c [m]
    Tensor F;       ///< [-]
    double vx, vy;  ///< c' [m/s]
    Tensor F_rate;  ///< F' [1/s]
    double a, b;    ///< reference half axes [m]
    double mass;    ///< [kg]
    double radius;  ///< sqrt(a b) [m]

    double reference_area() const { return std::numbers::pi * a * b; }
};
static_assert(sizeof(Grain) == 128);

inline double reach_of(const Grain& g) {
    return reach_of(g.F, g.a, g.b);
}

}  // namespace softgrain::sdem
