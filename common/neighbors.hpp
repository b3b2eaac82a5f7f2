#pragma once
// Cell grid + Verlet list: candidate pairs that stay complete while displacement and growth are below the
// skin.
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain {

struct Pair {
    int i, j;  ///< i < j
    friend bool operator==(const Pair&, const Pair&) = default;
    friend auto operator<=>(const Pair&, const Pair&) = default;
};

/// All pairs with |x_i - x_j| < reach_i + reach_j + skin, sorted by (i, j).
class NeighborList {
  public:
    /// x [n] [m]; reach [n] bounding radii [m]; skin > 0 [m].
    void build(std::span<const Vec2> x, std::span<const double> reach, double skin);

    /// True if a pair not in the list could touch: two grains together have eaten up the skin.
    bool stale(std::span<const Vec2> x, std::span<const double> reach) const;

    std::span<const Pair> pairs() const { return pairs_; }
    double skin() const { return skin_; }
    /// Positions and reaches of the last build, needed to restart with the same bits.
    std::span<const Vec2> built_at() const { return built_at_; }
    std::span<const double> built_reach() const { return built_reach_; }

  private:
    double skin_ = 0.0;
    std::vector<Pair> pairs_;
    std::vector<Vec2> built_at_;
    std::vector<double> built_reach_;
};

}  // namespace softgrain
