#pragma once
// What the scenario says about rigid DEM, in the units of the kernels.
#include "common/scenario.hpp"
#include "rigid_dem/laws/constants.hpp"

namespace softgrain::rigid_dem {

/// The keys of the scenario table [rigid_dem].
std::span<const KeySpec> keys();
/// Those that contradict each other.
std::vector<KeyFault> faults(const Settings& table);

struct Parameters {
    bool hertz;
    double stiffness;                   ///< of one grain at a rigid wall / E
    std::optional<double> shear_ratio;  ///< tangential / normal stiffness; Mindlin's if not given, of Hertz
    unsigned features;                  ///< of contacts between grains
    unsigned features_at_walls;
    bool rotates;  ///< contacts turn grains
    bool bonds_of_start_only;
    LawConstants between_grains, at_walls;
    double nonviscous_damping;   ///< Cundall's lambda_d
    double safety;               ///< share of the stability limit used as time step
    std::optional<double> skin;  ///< Verlet skin / smallest radius; by the grains' motion if not given
    double rest_tolerance;       ///< RestingBlocks' / smallest radius
    double overlap_limit;        ///< overlap / smaller radius beyond which the discs are not rigid any more

    /// Share of critical damping.
    double damping_ratio() const { return 0.5 * between_grains.damping; }
};

/// Throws InputError if Hertz's law is asked to hold bonds.
Parameters parameters_of(const Scenario& scenario);

/// K1 K2 / (K1 + K2) [N/m].
inline double in_series(double k1, double k2) {
    return k1 == k2 ? 0.5 * k1 : k1 * k2 / (k1 + k2);
}

/// Of the normal law and tangential over normal stiffness, of one contact.
struct ContactStiffness {
    double k;
    double shear_ratio;
};

/// A grain's part in the stiffness of its contacts.
struct GrainElasticity {
    double radius;   ///< [m]
    double modulus;  ///< E [N/m]
    double poisson_ratio;
};

/// Linear: K_i = stiffness E_i in series (DEM course, "Simplified linear elastic law"). Hertz: k = 4/3 E*
/// sqrt(R*) / t with E* and R* of the pair, spheres in a layer t = R_i + R_j thick, so that E [N/m] is that
/// of the solid times t; Mindlin's k_t / k_n = 4 G* / E*.
ContactStiffness stiffness_of_pair(const Parameters& law, const GrainElasticity& a, const GrainElasticity& b);
/// The same against something rigid and flat; t = 2 R.
ContactStiffness stiffness_at_wall(const Parameters& law, const GrainElasticity& grain);

}  // namespace softgrain::rigid_dem
