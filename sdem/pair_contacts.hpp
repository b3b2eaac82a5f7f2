#pragma once
// Contacts between grains: geometry and local force of every candidate pair.
#include <cstdint>
#include <span>
#include <vector>

#include "common/neighbors.hpp"
#include "sdem/contact.hpp"
#include "sdem/geometry/chord.hpp"
#include "sdem/grains.hpp"
#include "sdem/motion_law.hpp"

namespace softgrain::sdem {

/// How the chord of two grains is found.
enum class Geometry : std::uint8_t {
    batch,    ///< many pairs at a time; the fast way
    scalar,   ///< pair by pair; the oracle of the batch
    polygon,  ///< 360-sided polygons as in the paper; the base line for speed
};

/// What the evaluation of pairs reads.
struct PairInput {
    const Grains& grains;
    std::span<const Pair> pair;    ///< [pairs]
    std::span<const Image> image;  ///< [pairs] which image of j; empty without a periodic cell
    WallMotion motion;             ///< of the cell, for the images
    ContactLaw law;
    Geometry geometry;
    double contact_damping;
    bool with_rates;  ///< contact velocities are needed (damping or friction)
};

/// What is known of a pair afterwards.
struct PairOutput {
    std::span<Contact> contact;   ///< [pairs]
    std::span<ChordGuess> guess;  ///< [pairs], in and out
    std::span<Opening> opening;   ///< [pairs], for laws that use it; else empty
    std::span<double>
        slip_rate;  ///< [pairs] tangential velocity of j against i along the chord [m/s]; or empty
};

/// A pair that the law has no answer for.
struct BadPair {
    std::size_t pair = static_cast<std::size_t>(-1);  ///< the first one; -1 if there is none
    Overlap overlap = Overlap::none;
};

/// What an evaluation came upon.
struct PairNews {
    BadPair bad;
    std::vector<std::size_t> closed;  ///< pairs that did not touch before
};

/// Contacts of the pairs [begin, end). Every pair on its own: the same bits however the range is cut.
PairNews evaluate_pairs(const PairInput& in, const PairOutput& out, std::size_t begin, std::size_t end);

}  // namespace softgrain::sdem
