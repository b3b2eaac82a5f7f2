#include "common/neighbor_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr int most_levels = 24;
/// A grid finer than this gains nothing and costs memory.
constexpr double most_cells_per_grain = 2.0;
constexpr double least_cells = 64.0;

/// Largest whole number of cells of this size; safe for any number, not a number included.
int whole_cells(double length, double cell) {
    return static_cast<int>(std::max(1.0, std::min(1e6, std::floor(length / cell))));
}

/// Index of the cell of u, inside the grid for any u.
int index_in(double u, int cells) {
    return static_cast<int>(std::max(0.0, std::min(u * cells, cells - 1.0)));
}

int level_for(double reach, double largest) {
    return std::clamp(std::ilogb(largest / reach), 0, most_levels - 1);
}

Image sum(Image a, Image b) {
    return {static_cast<std::int8_t>(a.x + b.x), static_cast<std::int8_t>(a.y + b.y)};
}

}  // namespace

void NeighborGrid::build(std::span<const Vec2> x, std::span<const double> reach, double skin,
                         const Box& cell) {
    skin_ = skin;
    cell_ = cell;
    make_levels(reach);
    measure(x);
    sort(x, reach);
}

/// Levels that hold grains, by actual reach.
void NeighborGrid::make_levels(std::span<const double> reach) {
    const double largest = *std::max_element(reach.begin(), reach.end());
    std::array<Level, most_levels> all{};
    level_of_.resize(reach.size());
    for (std::size_t i = 0; i < reach.size(); ++i) {
        const int l = level_for(reach[i], largest);
        Level& level = all[static_cast<std::size_t>(l)];
        level.largest_reach = std::max(level.largest_reach, reach[i]);
        ++level.grains;
        level_of_[i] = static_cast<std::int8_t>(l);
    }
    levels_.clear();
    std::array<std::int8_t, most_levels> place{};
    for (std::size_t l = 0; l < all.size(); ++l) {
        place[l] = static_cast<std::int8_t>(levels_.size());
        if (all[l].grains > 0) levels_.push_back(all[l]);
    }
    for (std::int8_t& l : level_of_) l = place[static_cast<std::size_t>(l)];
}

/// The area that the grids cover, and its division for each level.
void NeighborGrid::measure(std::span<const Vec2> x) {
    const double widest = 2.0 * levels_.front().largest_reach + skin_;
    if (cell_.periodic) {
        const double largest = 2.0 * levels_.front().largest_reach;
        if (cell_.spacing() < 2.0 * widest)
            throw InputError(
                fmt::format("the periodic cell is too small for its grains: {:.4g} m across, at least {:.4g} "
                            "m are needed "
                            "for a largest grain of {:.4g} m; take more grains, or smaller ones",
                            cell_.spacing(), 2.0 * widest, largest));
        across_x_ = cell_.width() / std::hypot(1.0, cell_.shear_strain());
        across_y_ = cell_.height();
    } else {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double low[2]{infinity, infinity}, high[2]{-infinity, -infinity};
        for (const Vec2& p : x)
            for (int k = 0; k < 2; ++k) {
                low[k] = std::min(low[k], p[k]);
                high[k] = std::max(high[k], p[k]);
            }
        cell_ = Box{{low[0], high[0], low[1], high[1]}};
        across_x_ = cell_.width();
        across_y_ = cell_.height();
    }
    std::size_t cells = 0;
    for (Level& level : levels_) {
        const double size = 2.0 * level.largest_reach + skin_;
        level.columns = whole_cells(across_x_, size);
        level.rows = whole_cells(across_y_, size);
        const double most = std::max(least_cells, most_cells_per_grain * static_cast<double>(level.grains));
        const double wanted = static_cast<double>(level.columns) * level.rows;
        if (wanted > most) {
            const double coarser = std::sqrt(wanted / most);
            level.columns = whole_cells(level.columns, coarser);
            level.rows = whole_cells(level.rows, std::max(coarser, level.columns * level.rows / most));
        }
        level.first_cell = cells;
        cells += static_cast<std::size_t>(level.columns) * static_cast<std::size_t>(level.rows);
    }
    start_.assign(cells + 1, 0);
}

NeighborGrid::Unit NeighborGrid::unit(const Vec2& x) const {
    const double v = (x.y() - cell_.position[2]) / cell_.height();
    return {(x.x() - cell_.position[0] - cell_.tilt * v) / cell_.width(), v};
}

/// Counting sort into cells; within a cell grains stay in order of index.
void NeighborGrid::sort(std::span<const Vec2> x, std::span<const double> reach) {
    const std::size_t n = x.size();
    cell_by_grain_.resize(n);
    image_by_grain_.resize(cell_.periodic ? n : 0);
    for (std::size_t i = 0; i < n; ++i) {
        const Level& level = levels_[static_cast<std::size_t>(level_of_[i])];
        Vec2 at = x[i];
        if (cell_.periodic) {
            image_by_grain_[i] = cell_.image_of(at);
            at -= cell_.image(image_by_grain_[i]);
        }
        const Unit p = unit(at);
        const int own = index_in(p.v, level.rows) * level.columns + index_in(p.u, level.columns);
        cell_by_grain_[i] = static_cast<std::uint32_t>(level.first_cell) + static_cast<std::uint32_t>(own);
        ++start_[cell_by_grain_[i] + 1];
    }
    for (std::size_t c = 1; c < start_.size(); ++c) start_[c] += start_[c - 1];
    fill_.assign(start_.begin(), start_.end() - 1);
    order_.resize(n);
    level_.resize(n);
    cell_of_.resize(n);
    x_.resize(n);
    y_.resize(n);
    reach_.resize(n);
    wrapped_by_.resize(image_by_grain_.size());
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t s = fill_[cell_by_grain_[i]]++;
        const std::size_t first_cell = levels_[static_cast<std::size_t>(level_of_[i])].first_cell;
        Vec2 at = x[i];
        if (cell_.periodic) {
            at -= cell_.image(image_by_grain_[i]);
            wrapped_by_[s] = image_by_grain_[i];
        }
        order_[s] = static_cast<int>(i);
        level_[s] = level_of_[i];
        cell_of_[s] = static_cast<int>(cell_by_grain_[i] - first_cell);
        x_[s] = at.x();
        y_[s] = at.y();
        reach_[s] = reach[i];
    }
}

void NeighborGrid::find(std::size_t first, std::size_t last, std::vector<FoundPair>& found) const {
    for (std::size_t s = first; s < last; ++s) {
        const auto own = static_cast<std::size_t>(level_[s]);
        find_in_level(s, levels_[own], found);
        for (std::size_t l = 0; l < own; ++l) find_in_coarser(s, levels_[l], found);
    }
}

/// Its own cell and the four after it: the four before find this grain from theirs.
void NeighborGrid::find_in_level(std::size_t s, const Level& level, std::vector<FoundPair>& found) const {
    const int row = cell_of_[s] / level.columns;
    const int column = cell_of_[s] % level.columns;
    scan(s, level, row, column, column + 1, s + 1, found);
    scan(s, level, row + 1, column - 1, column + 1, 0, found);
}

void NeighborGrid::find_in_coarser(std::size_t s, const Level& level, std::vector<FoundPair>& found) const {
    const double range = reach_[s] + level.largest_reach + skin_;
    const Unit p = unit({x_[s], y_[s]});
    const int column = index_in(p.u, level.columns), row = index_in(p.v, level.rows);
    // Cells are as wide as the range or wider, so that the next cells on each side are enough.
    const double u = p.u * level.columns - column, v = p.v * level.rows - row;
    const double du = range / across_x_ * level.columns, dv = range / across_y_ * level.rows;
    const int left = u < du ? -1 : 0, right = u + du > 1.0 ? 1 : 0;
    const int below = v < dv ? -1 : 0, above = v + dv > 1.0 ? 1 : 0;
    for (int r = row + below; r <= row + above; ++r)
        scan(s, level, r, column + left, column + right, 0, found);
}

void NeighborGrid::scan(std::size_t s, const Level& level, int row, int first_column, int last_column,
                        std::size_t after, std::vector<FoundPair>& found) const {
    Image image;
    if (row < 0 || row >= level.rows) {
        if (!cell_.periodic) return;
        image.y = row < 0 ? -1 : 1;
        row -= image.y * level.rows;
    }
    const std::size_t row_start =
        level.first_cell + static_cast<std::size_t>(row) * static_cast<std::size_t>(level.columns);
    const auto columns = [&](int first, int last, std::int8_t turn) {
        const std::size_t begin = start_[row_start + static_cast<std::size_t>(first)];
        const std::size_t end = start_[row_start + static_cast<std::size_t>(last) + 1];
        test(s, turn == 0 ? std::max(begin, after) : begin, end, {turn, image.y}, found);
    };
    if (cell_.periodic && first_column < 0) columns(level.columns - 1, level.columns - 1, -1);
    columns(std::max(first_column, 0), std::min(last_column, level.columns - 1), 0);
    if (cell_.periodic && last_column >= level.columns) columns(0, 0, 1);
}

void NeighborGrid::test(std::size_t s, std::size_t first, std::size_t last, Image image,
                        std::vector<FoundPair>& found) const {
    const Vec2 shift = cell_.image(image);
    const double x = x_[s] - shift.x(), y = y_[s] - shift.y();
    const double reach = reach_[s] + skin_;
    for (std::size_t t = first; t < last; ++t) {
        const double dx = x_[t] - x, dy = y_[t] - y, limit = reach + reach_[t];
        if (!(dx * dx + dy * dy < limit * limit)) continue;
        const int i = order_[s], j = order_[t];
        // From the wrapped positions back to those given.
        const Image from_i = cell_.periodic ? sum(image, sum(wrapped_by_[s], -wrapped_by_[t])) : Image{};
        if (i < j)
            found.push_back({i, j, from_i});
        else
            found.push_back({j, i, -from_i});
    }
}

}  // namespace softgrain
