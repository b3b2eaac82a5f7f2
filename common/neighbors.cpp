#include "common/neighbors.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

struct Grid {
    Vec2 origin;
    double cell;
    int nx, ny;

    int column(double x) const { return std::clamp(static_cast<int>((x - origin.x()) / cell), 0, nx - 1); }
    int row(double y) const { return std::clamp(static_cast<int>((y - origin.y()) / cell), 0, ny - 1); }
};

Grid grid_around(std::span<const Vec2> x, double cell) {
    Vec2 low = x.front();
    Vec2 high = x.front();
    for (const Vec2& p : x) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const auto cells = [&](double length) { return static_cast<int>(std::min(length / cell, 4096.0)) + 1; };
    return {low, cell, cells(high.x() - low.x()), cells(high.y() - low.y())};
}

}  // namespace

void NeighborList::build(std::span<const Vec2> x, std::span<const double> reach, double skin) {
    skin_ = skin;
    built_at_.assign(x.begin(), x.end());
    built_reach_.assign(reach.begin(), reach.end());
    pairs_.clear();
    if (x.empty()) return;

    const double largest = *std::max_element(reach.begin(), reach.end());
    const Grid grid = grid_around(x, 2.0 * largest + skin);
    const auto cell_of = [&](const Vec2& p) {
        return static_cast<std::size_t>(grid.row(p.y()) * grid.nx + grid.column(p.x()));
    };
    // Counting sort of grains into cells; within a cell they stay in order of index.
    std::vector<int> start(static_cast<std::size_t>(grid.nx * grid.ny) + 1, 0);
    for (const Vec2& p : x) ++start[cell_of(p) + 1];
    for (std::size_t c = 1; c < start.size(); ++c) start[c] += start[c - 1];
    std::vector<int> member(x.size());
    std::vector<int> fill(start.begin(), start.end() - 1);
    for (std::size_t i = 0; i < x.size(); ++i)
        member[static_cast<std::size_t>(fill[cell_of(x[i])]++)] = static_cast<int>(i);

    for (std::size_t i = 0; i < x.size(); ++i) {
        const std::size_t first = pairs_.size();
        // A grain reaches over as many cells as its own and the largest partner's reach need.
        const double range = reach[i] + largest + skin;
        const int x0 = grid.column(x[i].x() - range), x1 = grid.column(x[i].x() + range);
        const int y0 = grid.row(x[i].y() - range), y1 = grid.row(x[i].y() + range);
        for (int row = y0; row <= y1; ++row) {
            const auto begin = static_cast<std::size_t>(start[static_cast<std::size_t>(row * grid.nx + x0)]);
            const auto end =
                static_cast<std::size_t>(start[static_cast<std::size_t>(row * grid.nx + x1) + 1]);
            for (std::size_t m = begin; m < end; ++m) {
                const auto j = static_cast<std::size_t>(member[m]);
                if (j <= i) continue;
                const double limit = reach[i] + reach[j] + skin;
                if ((x[j] - x[i]).squaredNorm() < limit * limit)
                    pairs_.push_back({static_cast<int>(i), static_cast<int>(j)});
            }
        }
        std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(first), pairs_.end());
    }
}

bool NeighborList::stale(std::span<const Vec2> x, std::span<const double> reach) const {
    if (x.size() != built_at_.size()) return true;
    double used = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        used = std::max(used, (x[i] - built_at_[i]).norm() + (reach[i] - built_reach_[i]));
    return 2.0 * used >= skin_;
}

}  // namespace softgrain
