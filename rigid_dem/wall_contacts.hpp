#pragma once
// Grains near straight walls. They are few: one at a time.
#include <array>
#include <cstdint>
#include <vector>

#include "common/box.hpp"
#include "rigid_dem/grain_record.hpp"
#include "rigid_dem/laws/contact.hpp"
#include "rigid_dem/parameters.hpp"

namespace softgrain::rigid_dem {

/// A grain that touches a wall or may soon.
struct WallContact {
    std::uint32_t record;
    std::uint8_t wall;
    ContactStiffness stiffness;
    ContactMemory memory;
};

struct WallSums {
    std::array<Vec2, 4> force{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};  ///< on walls [N]
    double friction_loss = 0.0, damping_loss = 0.0;                                     ///< in this step [J]
    double overlap = 0.0;                                                               ///< largest [m]
};

/// Positive where the grain touches the wall [m].
double wall_overlap(const GrainRecord& grain, int wall, const Box& box);

/// Force after a step dt, with every part that a law may have; takes the contact's memory along.
ContactForce wall_force(WallContact& contact, const GrainRecord& grain, const WallMotion& walls,
                        const Parameters& law, double dt);

/// Adds the forces of a block's contacts to its grains; `force` by record.
using WallKernel = WallSums (*)(std::vector<WallContact>& contacts, const std::vector<GrainRecord>& grain,
                                std::vector<ForceSum>& force, const WallMotion& walls,
                                const LawConstants& law, double dt);

/// The kernel with these parts of a law and no others; has_rolling comes with has_friction, and has_adhesion
/// is not for walls.
WallKernel wall_kernel(bool hertz, unsigned features);

}  // namespace softgrain::rigid_dem
