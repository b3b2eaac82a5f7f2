#include "rigid_dem/blocks.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "common/errors.hpp"

namespace softgrain::rigid_dem {
namespace {

/// A partner outside the block, until it has a place among the copies.
struct Outside {
    std::size_t partner;
    Image image;
    std::size_t pair;  ///< of the block

    auto key() const { return std::tuple(partner, image.x, image.y); }
};

/// Pairs of a block, and for each of its copies the grain in spatial order (in Halo::record for now).
void list_pairs(Block& block, const NeighborList& neighbors, std::size_t first, std::size_t last,
                const std::vector<char>& driven) {
    std::vector<Outside> outside;
    block.pairs.reserve(last - first);
    for (std::size_t k = first; k < last; ++k) {
        const auto i = static_cast<std::size_t>(neighbors.pairs()[k].i) - block.first_grain;
        const auto j = static_cast<std::size_t>(neighbors.pairs()[k].j);
        if (!driven.empty() && driven[block.first_grain + i] != 0 && driven[j] != 0) continue;
        const Image image = neighbors.images().empty() ? Image{} : neighbors.images()[k];
        block.pairs.push_back({static_cast<std::uint16_t>(i), 0});
        if (image == Image{} && j < block.first_grain + block.grains)
            block.pairs.back().j = static_cast<std::uint16_t>(j - block.first_grain);
        else
            outside.push_back({j, image, block.pairs.size() - 1});
    }
    std::sort(outside.begin(), outside.end(), [](const Outside& a, const Outside& b) {
        return std::pair(a.key(), a.pair) < std::pair(b.key(), b.pair);
    });
    for (std::size_t o = 0; o < outside.size(); ++o) {
        if (o == 0 || outside[o].key() != outside[o - 1].key())
            block.halo.push_back({static_cast<std::uint32_t>(outside[o].partner), outside[o].image});
        block.pairs[outside[o].pair].j = static_cast<std::uint16_t>(block.grains + block.halo.size() - 1);
    }
}

}  // namespace

std::vector<Block> cut_into_blocks(const NeighborList& neighbors, std::size_t grains, std::size_t size,
                                   const std::vector<char>& driven) {
    std::vector<Block> blocks((grains + size - 1) / size);
    const auto pairs = neighbors.pairs();
#pragma omp parallel for schedule(static) if (blocks.size() > 8)
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        Block& block = blocks[b];
        block.first_grain = b * size;
        block.grains = std::min(size, grains - block.first_grain);
        const auto first_of = [&](std::size_t grain) {
            return std::lower_bound(pairs.begin(), pairs.end(), Pair{static_cast<int>(grain), 0}) -
                   pairs.begin();
        };
        list_pairs(block, neighbors, static_cast<std::size_t>(first_of(block.first_grain)),
                   static_cast<std::size_t>(first_of(block.first_grain + block.grains)), driven);
    }
    std::size_t record = 0;
    for (Block& block : blocks) {
        if (block.grains + block.halo.size() > std::size_t{1} + std::numeric_limits<std::uint16_t>::max())
            throw InputError("a grain has more than 60000 neighbours: take sizes that differ less");
        block.first_record = record;
        record += block.grains + block.halo.size();
    }
    for (Block& block : blocks)
        for (std::size_t h = 0; h < block.halo.size(); ++h) {
            Halo& copy = block.halo[h];
            const std::size_t home = copy.record / size, place = copy.record % size;
            copy.record = static_cast<std::uint32_t>(blocks[home].first_record + place);
            blocks[home].arrivals.push_back(
                {static_cast<std::uint32_t>(block.first_record + block.grains + h),
                 static_cast<std::uint16_t>(place)});
        }
    return blocks;
}

}  // namespace softgrain::rigid_dem
