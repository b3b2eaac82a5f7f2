#pragma once
// Many pairs side by side on their way through the contact law.
#include <cstddef>

#include "sdem/contact.hpp"
#include "sdem/geometry/chord_batch.hpp"
#include "sdem/grain.hpp"
#include "sdem/motion_law.hpp"

namespace softgrain::sdem {

/// Up to 64 pairs. `a` is the larger grain of each pair, as chords want it.
struct PairLanes {
    static constexpr int capacity = ChordBatch::capacity;
    using Lane = double[capacity];

    int count = 0;
    std::size_t pair[capacity];
    // In: both grains of each pair as they lie in memory, and the guess for the chord.
    alignas(64) Grain a[capacity], b[capacity];
    alignas(64) ChordGuess guess[capacity];
    alignas(64) Lane offset_x, offset_y, offset_vx, offset_vy;  // of the image of b, periodic cells only
    alignas(64) Lane turn;                                      // 1, or -1 if a is the pair's j
    alignas(64) Lane E_a, E_b;
    ChordBatch chord;
    // Between two loops.
    alignas(64) Lane dvx, dvy, a_rxx, a_rxy, a_ryx, a_ryy, b_rxx, b_rxy, b_ryx, b_ryy, mass_a, mass_b;
    // Out.
    alignas(64) Contact contact[capacity];
    alignas(64) Opening opening[capacity];
    alignas(64) Lane slip, stiffness;
};

/// Chords of all lanes but those that need the careful way, whose chord.sound is 0.
void find_chords(PairLanes& batch, bool with_rates, bool periodic);
/// Sets the lanes up for the careful way only.
void skip_chords(PairLanes& batch, bool with_rates, bool periodic);
/// Contacts of all lanes whose chord.sound is not 0; the others do not touch.
void answer_lanes(PairLanes& batch, ContactLaw law, bool with_rates, double damping);

}  // namespace softgrain::sdem
