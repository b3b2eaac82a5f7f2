#pragma once
// Grids of cells + Verlet list: candidate pairs that stay complete while displacement and growth are below
// the skin.
#include <cstdint>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/neighbor_grid.hpp"
#include "common/vec.hpp"

namespace softgrain {

struct Pair {
    int i, j;  ///< i < j
    friend bool operator==(const Pair&, const Pair&) = default;
    friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// What a moving cell has done to the positions x = F X + shift of grains that follow it.
struct CellChange {
    Mat2 F = Mat2::Identity();
    Vec2 shift = Vec2::Zero();
    double loss = 0.0;  ///< 1 - the smaller stretch of F, at least 0
};
/// Of a periodic cell, by the same lattice vectors before and now.
CellChange cell_change(const Box& before, const Box& now);

/// All pairs with |x_j - x_i (+ image)| < reach_i + reach_j + skin, sorted by (i, j). The same list for any
/// number of threads; made for size ratios up to 100 and beyond.
class NeighborList {
  public:
    /// A lean list frees what it works with as soon as it can, instead of keeping it for the next build.
    explicit NeighborList(bool lean = false) : lean_(lean) {}

    /// x [n] [m]; reach [n] bounding radii [m]; skin > 0 [m].
    void build(std::span<const Vec2> x, std::span<const double> reach, double skin);
    /// The same in a periodic cell (with walls if it is not periodic). Grains may lie outside the cell.
    /// Throws InputError if the cell is so small that a pair could meet twice.
    void build(std::span<const Vec2> x, std::span<const double> reach, double skin, const Box& cell);
    /// The same with positions and reaches that the list may keep.
    void build(std::vector<Vec2>&& x, std::vector<double>&& reach, double skin, const Box& cell);

    /// True if a pair not in the list could touch: two grains together have eaten up the skin.
    bool stale(std::span<const Vec2> x, std::span<const double> reach) const;
    /// The same in a periodic cell, by the lattice vectors of the build (moved since, but not flipped).
    /// Motion along with the cell does not count, its deformation does.
    bool stale(std::span<const Vec2> x, std::span<const double> reach, const Box& cell) const;

    /// Leaves out the pairs that `keep(i, j)` does not want.
    template <class Keep>
    void keep_if(const Keep& keep) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < pairs_.size(); ++k) {
            if (!keep(pairs_[k].i, pairs_[k].j)) continue;
            if (!images_.empty()) images_[kept] = images_[k];
            pairs_[kept++] = pairs_[k];
        }
        pairs_.resize(kept);
        if (!images_.empty()) images_.resize(kept);
    }

    /// Frees the pairs; stale() goes on to work.
    void forget_pairs();

    std::span<const Pair> pairs() const { return pairs_; }
    /// [pairs] The vector from i to j is x_j - x_i + cell.image(images()[k]); empty without a periodic cell.
    std::span<const Image> images() const { return images_; }
    /// The cell of the last build, needed to restart with the same bits.
    const Box& built_cell() const { return built_cell_; }
    double skin() const { return skin_; }
    /// Positions and reaches of the last build, needed to restart with the same bits.
    std::span<const Vec2> built_at() const { return built_at_; }
    std::span<const double> built_reach() const { return built_reach_; }

  private:
    void build_pairs(double skin, const Box& cell);
    void find_pairs();

    bool lean_;
    double skin_ = 0.0;
    Box built_cell_;
    std::vector<Pair> pairs_;
    std::vector<Image> images_;
    std::vector<Vec2> built_at_;
    std::vector<double> built_reach_;

    // storage of a build, kept for the next one
    struct Partner {
        int j;
        Image image;
    };
    NeighborGrid grid_;
    std::vector<std::vector<FoundPair>> found_;  ///< by block of grains
    std::vector<std::uint32_t> start_, fill_;    ///< [n + 1] of each grain's partners
    std::vector<Partner> partner_;
};

}  // namespace softgrain
