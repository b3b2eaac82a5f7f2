#pragma once
// Contacts of grains with straight walls.
#include "sdem/contact_list.hpp"

namespace softgrain::sdem {

/// What the evaluation of wall contacts reads.
struct WallInput {
    const Grains& grains;
    WallMotion motion;
    ContactLaw law;
    double contact_damping;
};

/// Fills list.wall_contact, and slip rates if there is a history. The first wall pair that the law has no
/// answer for, or -1.
std::size_t evaluate_walls(const WallInput& in, ContactList& list);

}  // namespace softgrain::sdem
