#pragma once
// Discs divided into blocks that are relaxed one by one: neighbours of one group.
#include <vector>

#include "common/contact_dynamics/discs.hpp"

namespace softgrain {

/// Block of every disc, numbered from 0. A block holds discs of one group only; a group of more than
/// `most_discs` is cut in halves across its longer side until no part is larger. Depends on nothing but its
/// arguments.
struct ContactBlocks {
    std::vector<int> of_disc;         ///< [n]
    std::vector<int> group_of_block;  ///< [blocks]

    ContactBlocks() = default;
    ContactBlocks(const Discs& discs, int most_discs);
    int size() const { return static_cast<int>(group_of_block.size()); }
};

}  // namespace softgrain
