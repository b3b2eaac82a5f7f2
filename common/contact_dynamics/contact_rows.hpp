#pragma once
// Persistent list of contact candidates, ordered so that it can be swept in parallel with the same bits.
#include <cstddef>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/contact_dynamics/discs.hpp"
#include "common/neighbors.hpp"

namespace softgrain {

/// Candidate pairs as structure of arrays. Rows of one group come first, group by group (a block); rows
/// between groups follow. Inside a block and between groups rows are sorted by colour: a colour touches no
/// disc twice. Impulses are kept divided by the reduced mass m_e = 1/(1/m_i + 1/m_j), as velocities [m/s].
struct ContactRows {
    std::vector<int> i, j;           ///< discs, i < j
    std::vector<Vec2> direction;     ///< unit normal from i to j
    std::vector<double> gap_speed;   ///< gap / h [m/s], negative if the discs overlap
    std::vector<double> share;       ///< m_e / m_i; that of j is 1 - share
    std::vector<double> normal;      ///< normal impulse / m_e, >= 0
    std::vector<double> tangential;  ///< tangential impulse / m_e, along n turned by +90 degrees, on j
    std::vector<int> block_start;    ///< [groups + 1] first row of each group
    std::vector<int> colour_start;   ///< [colours + 1] first row of each colour between groups

    std::size_t size() const { return i.size(); }
    std::size_t within_groups() const { return static_cast<std::size_t>(block_start.back()); }
};

/// Candidate disc-wall contacts, sorted by group; m_e is the mass of the disc.
struct WallRows {
    std::vector<int> disc, wall;
    std::vector<double> gap_speed;  ///< [m/s]
    std::vector<double> normal;     ///< impulse / m [m/s], >= 0
    std::vector<int> block_start;   ///< [groups + 1]

    std::size_t size() const { return disc.size(); }
};

/// Rows of the candidate pairs (sorted by i, j), with zero impulses. Depends on nothing but its arguments.
ContactRows make_contact_rows(std::span<const Pair> pairs, const Discs& discs, int groups);

/// Rows of the discs nearer than `skin` to a wall, with zero impulses.
WallRows make_wall_rows(const Discs& discs, const Box& box, double skin, int groups);

/// Copies the impulses of contacts that are in both lists.
void carry_impulses(const ContactRows& from, ContactRows& to);
void carry_impulses(const WallRows& from, WallRows& to);

}  // namespace softgrain
