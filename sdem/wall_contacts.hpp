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

/// What an evaluation came upon.
struct WallNews {
    std::size_t bad = static_cast<std::size_t>(-1);  ///< first wall pair without an answer; -1 if none
    std::vector<std::size_t> closed;                 ///< wall pairs that did not touch before
};

/// Contacts of the wall pairs [begin, end), and their slip rates if there is a history.
WallNews evaluate_walls(const WallInput& in, ContactList& list, std::size_t begin, std::size_t end);

}  // namespace softgrain::sdem
