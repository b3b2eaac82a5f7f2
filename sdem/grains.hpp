#pragma once
// The state of the grains, and what their material says.
#include <cstdint>
#include <vector>

#include "sdem/geometry/ellipse.hpp"
#include "sdem/grain.hpp"

namespace softgrain::sdem {

inline Mat2 matrix_of(const Tensor& t) {
    Mat2 m;
    m << t.xx, t.xy, t.yx, t.yy;
    return m;
}
inline Tensor tensor_of(const Mat2& m) {
    return {m(0, 0), m(0, 1), m(1, 0), m(1, 1)};
}

inline Ellipse ellipse_of(const Grain& g) {
    return make_ellipse(Vec2{g.x, g.y}, matrix_of(g.F), Vec2{g.a, g.b});
}

/// Constants of one grain class.
struct GrainMaterial {
    double E;                 ///< [N/m]
    double density;           ///< [kg/m^2]
    double mu, kappa;         ///< Mollon 2022, Eq. 45, 46 [N/m]
    double plane_E;           ///< E / (1 - nu^2) [N/m]
    double bulge;             ///< gamma (1-2nu)/(1-nu) of the lens potential
    double shape_damping;     ///< gamma of Eq. 62-64 times R [m/s]
    double dilation_inertia;  ///< inertia added to changes of area, in units of the grain's own
    double yield;             ///< shear stress at which the grain flows [N/m]; infinite if it does not
};

/// All grains, sorted in space so that neighbours lie close in memory.
struct Grains {
    std::vector<Grain> grain;               ///< [n]
    std::vector<Vec2> center;               ///< [n] c again, for the search of neighbours [m]
    std::vector<Vec2> next_center;          ///< [n] c after the step being made [m]
    std::vector<double> reach;              ///< [n] largest half axis [m]
    std::vector<std::uint8_t> grain_class;  ///< [n]; empty if there is one class only
    std::vector<GrainMaterial> material;    ///< [classes]
    std::vector<int> original;              ///< [n] index of the grain in the packing

    std::size_t size() const { return grain.size(); }
    const GrainMaterial& material_of(std::size_t g) const {
        return material[grain_class.empty() ? 0 : grain_class[g]];
    }
};

}  // namespace softgrain::sdem
