#pragma once
// What a contact is made of, chosen once for a scene, and its numbers.
#include <cstdint>

namespace softgrain::rigid_dem {

enum ContactPart : unsigned {
    no_part = 0,
    has_damping = 1U << 0,
    has_friction = 1U << 1,
    has_rolling = 1U << 2,
    has_adhesion = 1U << 3,
    every_part = (1U << 4) - 1,
};

/// The same for all contacts of a kind: between grains, or with walls.
struct LawConstants {
    double damping = 0.0;            ///< twice the share of critical damping
    double friction = 0.0;           ///< Coulomb coefficient
    double rolling_friction = 0.0;   ///< largest moment / (N rolling radius)
    double rolling_stiffness = 0.0;  ///< k_r / (k_t rolling radius^2)
    double adhesion = 0.0;           ///< largest pull / adhesive length [N/m]
    double shear_adhesion = 0.0;     ///< added to the Coulomb limit of a bond / largest pull
    double sticks = 0.0;             ///< 1 if contacts that form are bonds
};

}  // namespace softgrain::rigid_dem
