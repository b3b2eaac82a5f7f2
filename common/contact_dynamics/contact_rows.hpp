#pragma once
// Persistent list of contact candidates, ordered so that it can be relaxed in parallel with the same bits.
#include <cstddef>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/contact_dynamics/contact_blocks.hpp"
#include "common/contact_dynamics/discs.hpp"
#include "common/neighbors.hpp"

namespace softgrain {

/// The rows between two blocks.
struct Seam {
    int a, b;         ///< blocks, a < b
    int first, last;  ///< rows [first, last)
};

/// What has to be stored with a row.
struct RowContent {
    bool tangential = false, rolling = false;
};

/// Candidate pairs as structure of arrays: block by block, then seam by seam. A block begins with batches of
/// rows (contact_sweep::batch_rows) that touch no disc twice; rows that are left over follow one by one.
/// Seams are sorted by colour: those of a colour touch no block twice. Impulses are kept divided by the
/// reduced mass m_e = 1/(1/m_i + 1/m_j), as velocities [m/s].
struct ContactRows {
    std::vector<int> i, j;          ///< discs, i < j
    std::vector<Vec2> direction;    ///< unit normal from i to j
    std::vector<double> gap_speed;  ///< gap / h [m/s], negative if the discs overlap
    std::vector<double> share;      ///< m_e / m_i; that of j is 1 - share
    std::vector<double> normal;     ///< normal impulse / m_e, >= 0
    std::vector<double>
        tangential;               ///< tangential impulse / m_e, along n turned by +90 degrees, on j; or empty
    std::vector<double> rolling;  ///< angular impulse / m_e on j [m^2/s]; or empty
    std::vector<int> row_of_pair;   ///< the rows in the order of (i, j)
    std::vector<int> block_start;   ///< [blocks + 1] first row of each block
    std::vector<int> first_single;  ///< [blocks] first row after the batches
    std::vector<Seam> seams;
    std::vector<int> colour_start;  ///< [colours + 1] first seam of each colour

    std::size_t size() const { return i.size(); }
    double tangential_of(std::size_t row) const { return tangential.empty() ? 0.0 : tangential[row]; }
};

/// Candidate disc-wall contacts, sorted by block; m_e is the mass of the disc.
struct WallRows {
    std::vector<int> disc, wall;
    std::vector<double> gap_speed;  ///< [m/s]
    std::vector<double> normal;     ///< impulse / m [m/s], >= 0
    std::vector<int> block_start;   ///< [blocks + 1]

    std::size_t size() const { return disc.size(); }
};

/// Rows of the candidate pairs (sorted by i, j), with zero impulses. Depends on nothing but its arguments.
ContactRows make_contact_rows(std::span<const Pair> pairs, const Discs& discs, const ContactBlocks& blocks,
                              RowContent content);

/// Rows of the discs nearer than `skin` to a wall, with zero impulses.
WallRows make_wall_rows(const Discs& discs, const Box& box, double skin, const ContactBlocks& blocks);

/// Copies the impulses of contacts that are in both lists.
void carry_impulses(const ContactRows& from, ContactRows& to);
void carry_impulses(const WallRows& from, WallRows& to);

}  // namespace softgrain
