#pragma once
// Grids of cells for grains of very different size: a grid for each class of reach, all over one area.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// A pair found, with the image as in NeighborList::images.
struct FoundPair {
    int i, j;  ///< i < j
    Image image;
};

/// Grains in cell order. A level holds the grains whose reach is within a factor of two; its cells are as
/// large as two of them reach. Every pair is found from its grain of the finer level. Keeps its storage for
/// the next build.
class NeighborGrid {
  public:
    /// Throws InputError if `cell` is periodic and too small.
    void build(std::span<const Vec2> x, std::span<const double> reach, double skin, const Box& cell);

    /// Pairs found from the grains first to last - 1 of the cell order, in no useful order.
    void find(std::size_t first, std::size_t last, std::vector<FoundPair>& found) const;

    std::size_t size() const { return order_.size(); }

  private:
    struct Level {
        double largest_reach = 0.0;
        std::size_t grains = 0;
        int columns = 1, rows = 1;
        std::size_t first_cell = 0;  ///< of its cells, row by row
    };
    /// Position in units of the area's sides.
    struct Unit {
        double u, v;
    };

    void measure(std::span<const Vec2> x);
    void make_levels(std::span<const double> reach);
    void sort(std::span<const Vec2> x, std::span<const double> reach);
    Unit unit(const Vec2& x) const;
    void find_in_level(std::size_t s, const Level& level, std::vector<FoundPair>& found) const;
    void find_in_coarser(std::size_t s, const Level& level, std::vector<FoundPair>& found) const;
    /// Tests grain s against the cells of a row; columns and row may lie outside a periodic cell.
    void scan(std::size_t s, const Level& level, int row, int first_column, int last_column,
              std::size_t after, std::vector<FoundPair>& found) const;
    void test(std::size_t s, std::size_t first, std::size_t last, Image image,
              std::vector<FoundPair>& found) const;

    double skin_ = 0.0;
    Box cell_;                                 ///< periodic cell, or the rectangle around the centres
    double across_x_ = 0.0, across_y_ = 0.0;   ///< its thickness across columns and rows [m]
    std::vector<Level> levels_;                ///< coarse to fine
    std::vector<std::uint32_t> start_, fill_;  ///< [cells + 1] into the cell order
    // by grain [n]
    std::vector<std::int8_t> level_of_;
    std::vector<std::uint32_t> cell_by_grain_;
    std::vector<Image> image_by_grain_;
    // in cell order [n]
    std::vector<int> order_, cell_of_;
    std::vector<std::int8_t> level_;
    std::vector<double> x_, y_, reach_;  ///< wrapped into a periodic cell
    std::vector<Image> wrapped_by_;
};

}  // namespace softgrain
