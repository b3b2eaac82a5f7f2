#pragma once
// What a run chooses of the grains' mechanics.
#include <cstddef>
#include <cstdint>

#include "common/vec.hpp"

namespace softgrain::sdem {

enum class ContactLaw : std::uint8_t { mollon2022, lens_potential };

/// How much a grain may deform. The paper's names: two dimensions, number of deformation modes.
enum class Kinematics : std::uint8_t {
    D2F0,  ///< rigid
    D2F1,  ///< volume only
    D2F3,  ///< volume and shape
};

/// Stress of a grain against its deformation.
enum class GrainLaw : std::uint8_t { linear, neo_hookean };

/// What the motion of a grain depends on besides its state.
struct MotionLaw {
    Kinematics kinematics = Kinematics::D2F3;
    GrainLaw grain_law = GrainLaw::linear;
    ContactLaw contact_law = ContactLaw::mollon2022;
    bool imposes_area = false;  ///< nu = 0.5 of mollon2022: Eq. 67, 68
    bool shape_damping = true;
    bool dilation_inertia = false;  ///< some class has it
    bool plastic = false;           ///< some class yields
    Vec2 gravity = Vec2::Zero();    ///< acts on the centre [m/s^2]
};

/// Grains per block. Blocks are the unit of threads, so sums over blocks do not depend on their number.
inline constexpr std::size_t grains_per_block = 64;

}  // namespace softgrain::sdem
