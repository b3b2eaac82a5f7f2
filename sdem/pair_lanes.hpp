#pragma once
// Many pairs side by side on their way through the contact law.
#include <cstddef>

#include "sdem/geometry/chord_batch.hpp"
#include "sdem/motion_law.hpp"

namespace softgrain::sdem {

/// Up to 64 pairs side by side. `a` is the larger grain of each pair, as chords want it.
struct PairLanes {
    static constexpr int lanes = ChordBatch::capacity;
    ChordBatch chord;
    std::size_t pair[lanes];
    bool swapped[lanes];  ///< a is the pair's j
    // Known of the grains: velocity of b against a, F' times reference axes, masses, radii, constants.
    alignas(64) double dvx[lanes], dvy[lanes];
    alignas(64) double a_rxx[lanes], a_rxy[lanes], a_ryx[lanes], a_ryy[lanes];
    alignas(64) double b_rxx[lanes], b_rxy[lanes], b_ryx[lanes], b_ryy[lanes];
    alignas(64) double mass_a[lanes], mass_b[lanes], radius_a[lanes], radius_b[lanes];
    alignas(64) double E_a[lanes], E_b[lanes], plane_E_a[lanes], plane_E_b[lanes];
    // The law's answer.
    alignas(64) double q[lanes], q_damping[lanes], stiffness[lanes], share_a[lanes], slip[lanes];
};

/// Local forces of all lanes from their chords.
void answer_lanes(PairLanes& batch, ContactLaw law, bool with_rates, double damping);

}  // namespace softgrain::sdem
