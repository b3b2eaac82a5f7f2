#pragma once
// Grains in spatial order, cut into blocks that a core's own cache holds. A block has copies of the grains
// outside that its pairs reach, shifted into the right image; so nothing in a pair's work knows of other
// blocks, threads or periodic cells.
#include <array>
#include <cstddef>
#include <vector>

#include "common/neighbors.hpp"
#include "rigid_dem/pair_kernel.hpp"

namespace softgrain::rigid_dem {

/// A copy of a grain of any block.
struct Halo {
    std::uint32_t record;  ///< of the grain
    Image image;           ///< that the copy lies in
};

/// Forces that other blocks' pairs leave for a grain.
struct Arrival {
    std::uint32_t copy;  ///< record of the copy
    std::uint16_t grain;
};

struct Block {
    std::size_t first_grain = 0, grains = 0;  ///< in spatial order
    std::size_t first_record = 0;             ///< its grains', then its copies'
    bool is_driven = false;                   ///< a grain of it moves as it is told
    std::vector<Halo> halo;
    std::vector<Arrival> arrivals;  ///< in order of the copies
    std::vector<LocalPair> pairs;   ///< of its grains with later ones, sorted
    /// Of its pairs, padded to whole batches; empty if the law has no use for them.
    std::vector<double> k, shear_ratio, shear_compliance, shear, dashpot, grip, moment, bond;

    std::size_t padded() const { return (pairs.size() + lanes - 1) / lanes * lanes; }
};

/// What contacts remember.
inline constexpr std::array memories{&Block::shear, &Block::dashpot, &Block::grip, &Block::moment,
                                     &Block::bond};

inline constexpr std::size_t grains_per_block = 1024;
/// Where blocks may rest: more copies, but less is awake around what moves.
inline constexpr std::size_t grains_per_resting_block = 256;

/// Blocks of `size` grains, the last of fewer, for a list of neighbours by spatial order. Throws InputError
/// if one grain has more neighbours than a block can count. Pairs of two driven grains are left out; `driven`
/// by spatial order, empty for none.
std::vector<Block> cut_into_blocks(const NeighborList& neighbors, std::size_t grains, std::size_t size,
                                   const std::vector<char>& driven);

}  // namespace softgrain::rigid_dem
