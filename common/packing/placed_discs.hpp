#pragma once
// Discs put down one after the other, and whether there is room for one more.
#include <vector>

#include "common/box.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// In a box [0, width] x [0, height], with walls or periodic. Every disc stands in all grid cells that its
/// square covers, so that discs of very different sizes cost little.
class PlacedDiscs {
  public:
    /// `cell` near the diameter of most discs [m].
    PlacedDiscs(const Box& box, double cell);

    void add(const Vec2& center, double radius);
    /// True if a disc here overlaps one that was added.
    bool overlaps(const Vec2& center, double radius) const;

  private:
    struct Disc {
        Vec2 center;
        double radius;
    };
    /// True as soon as `found(cell)` is, over the cells of the disc's square.
    template <class Found>
    bool any_cell(const Vec2& center, double radius, const Found& found) const;

    Box box_;
    int columns_, rows_;
    std::vector<std::vector<Disc>> cells_;
};

}  // namespace softgrain
