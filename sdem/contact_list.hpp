#pragma once
// All candidate contacts of the sample: who may touch whom, and what came of it.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/neighbors.hpp"
#include "sdem/pair_contacts.hpp"

namespace softgrain::sdem {

/// A grain near a wall.
struct WallPair {
    int grain, wall;
    friend auto operator<=>(const WallPair&, const WallPair&) = default;
};

/// What contacts remember besides their geometry; only if they slide or stick.
struct ContactHistory {
    std::vector<double> spring;      ///< elongation of the tangential spring, of j against i [m]
    std::vector<double> adhesion;    ///< adhesive stress at work [N/m]
    std::vector<double> lens;        ///< overlap area at the last step [m^2]
    std::vector<double> tangential;  ///< force on j along the turned chord, per chord length [N/m]
    std::vector<double> slip_rate;   ///< [m/s]

    void resize(std::size_t size);
};

class ContactList {
  public:
    /// True if a contact not in the list could have come about.
    bool stale(const Grains& grains, const Box& box) const;
    /// Finds all candidates; what touching pairs remember moves with them. center [n] and skin [m], reach [n]
    /// largest half axes [m].
    void build(std::span<const Vec2> center, std::span<const double> reach, const Box& box, double skin);
    /// Shares of the pairs: the smaller and the softer grain gives way.
    void find_shares(const Grains& grains);
    std::span<const Pair> pairs() const { return neighbors_.pairs(); }
    std::span<const Image> images() const { return neighbors_.images(); }
    std::span<const WallPair> wall_pairs() const { return wall_pair_; }
    const NeighborList& neighbors() const { return neighbors_; }
    const Box& built_box() const { return built_box_; }

    std::vector<double> share;          ///< [pairs] of the overlap that i gives way to
    std::vector<Contact> pair_contact;  ///< [pairs]
    std::vector<Contact> wall_contact;  ///< [wall pairs]; i is the grain
    std::vector<ChordGuess> guess;      ///< [pairs]
    std::vector<Opening> pair_opening;  ///< [pairs] if kept
    std::vector<Opening> wall_opening;  ///< [wall pairs]
    bool keeps_openings = false;        ///< of pairs, for laws that use them
    bool keeps_history = false;         ///< for laws with a memory
    ContactHistory pair_history, wall_history;

    /// Slots of the pairs whose first grain is g: [first(g), first(g + 1)).
    std::size_t first(std::size_t g) const { return first_[g]; }
    /// Slots of the pairs whose second grain is g.
    std::span<const std::uint32_t> second(std::size_t g) const {
        return {second_.data() + second_start_[g], second_start_[g + 1] - second_start_[g]};
    }
    /// True if any of the grains [begin, end) may touch one before `first`.
    bool reach_below(std::size_t first, std::size_t begin, std::size_t end) const;
    std::size_t wall_first(std::size_t g) const { return wall_start_[g]; }

  private:
    NeighborList neighbors_;
    std::vector<std::uint32_t> first_, second_start_, second_, wall_start_;
    std::vector<WallPair> wall_pair_;
    Box built_box_;
};

}  // namespace softgrain::sdem
