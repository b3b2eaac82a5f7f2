#pragma once
// Deterministic sums: forces are computed per contact in any order, then each grain adds its own in list
// order.
#include <cstddef>
#include <span>
#include <vector>

#include "common/neighbors.hpp"

namespace softgrain {

/// For each grain, the pairs it takes part in, in the order of the pair list.
class PairsOfGrain {
  public:
    struct Entry {
        int pair;     ///< index into the pair list
        bool second;  ///< true if this grain is the pair's j
    };

    void build(std::span<const Pair> pairs, std::size_t grains);
    std::span<const Entry> of(std::size_t grain) const {
        return {entries_.data() + start_[grain], start_[grain + 1] - start_[grain]};
    }

  private:
    std::vector<std::size_t> start_;
    std::vector<Entry> entries_;
};

}  // namespace softgrain
