#pragma once
// What the scenario says about rigid DEM, in the units of the kernel.
#include "common/scenario.hpp"

namespace softgrain::rigid_dem {

/// The keys of the scenario table [rigid_dem].
std::span<const KeySpec> keys();

/// Linear contact law (DEM course, "Simplified linear elastic law"): two springs in series, K_i = stiffness
/// E_i.
struct Parameters {
    double stiffness;      ///< k_n of a grain at a rigid wall / E
    double shear_ratio;    ///< k_t / k_n
    double friction;       ///< Coulomb coefficient; 0 removes rotation and history
    double damping_ratio;  ///< of critical, from the coefficient of restitution
    double safety;         ///< share of the stability limit used as time step
    double skin;           ///< Verlet skin / smallest radius
    double overlap_limit;  ///< overlap / smaller radius beyond which the discs are not rigid any more
};

Parameters parameters_of(const Scenario& scenario);

/// K1 K2 / (K1 + K2) [N/m].
inline double in_series(double k1, double k2) {
    return k1 == k2 ? 0.5 * k1 : k1 * k2 / (k1 + k2);
}

}  // namespace softgrain::rigid_dem
