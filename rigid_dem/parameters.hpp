#pragma once
// What the scenario says about rigid DEM, in the units of the kernel.
#include "common/scenario.hpp"

namespace softgrain::rigid_dem {

/// The keys of the scenario table [rigid_dem].
std::span<const KeySpec> keys();

/// Linear contact law (DEM course, "Simplified linear elastic law"): two springs in series, K = K1 K2 / (K1 +
/// K2).
struct Parameters {
    double pair_stiffness;  ///< k_n between two grains [N/m]
    double wall_stiffness;  ///< k_n at a rigid wall [N/m]
    double shear_ratio;     ///< k_t / k_n
    double friction;        ///< Coulomb coefficient; 0 removes rotation and history
    double damping_ratio;   ///< of critical, from the coefficient of restitution
    double density;         ///< [kg/m^2]
    double young;           ///< E [N/m]
    double safety;          ///< share of the stability limit used as time step
    double skin;            ///< Verlet skin / smallest radius
    double overlap_limit;   ///< overlap / smaller radius beyond which the discs are not rigid any more
};

Parameters parameters_of(const Scenario& scenario);

}  // namespace softgrain::rigid_dem
