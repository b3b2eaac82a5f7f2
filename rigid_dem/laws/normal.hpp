#pragma once
// Elastic normal forces. `k` belongs to the pair; negative overlaps are tension, for bonds.
#include <cmath>

#include "common/simd.hpp"

namespace softgrain::rigid_dem {

/// N = k overlap (DEM course, "Simplified linear elastic law"), k [N/m].
struct Linear {
    static constexpr bool constant_stiffness = true;
    SOFTGRAIN_INLINE static double force(double k, double overlap) { return k * overlap; }
    SOFTGRAIN_INLINE static double stiffness(double k, double) { return k; }
    SOFTGRAIN_INLINE static double energy(double k, double overlap) { return 0.5 * k * overlap * overlap; }
};

/// N = k overlap^(3/2) (DEM course, "Hertz contact"), k [N/m^1.5].
struct Hertz {
    static constexpr bool constant_stiffness = false;
    SOFTGRAIN_INLINE static double force(double k, double overlap) {
        return k * overlap * std::sqrt(std::abs(overlap));
    }
    SOFTGRAIN_INLINE static double stiffness(double k, double overlap) {
        return 1.5 * k * std::sqrt(std::abs(overlap));
    }
    SOFTGRAIN_INLINE static double energy(double k, double overlap) {
        return 0.4 * k * overlap * overlap * std::sqrt(std::abs(overlap));
    }
};

}  // namespace softgrain::rigid_dem
