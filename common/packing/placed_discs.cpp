#include "common/packing/placed_discs.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

constexpr double most_cells_across = 4096.0;

int cells_across(double length, double cell) {
    return static_cast<int>(std::clamp(std::floor(length / cell), 1.0, most_cells_across));
}

}  // namespace

PlacedDiscs::PlacedDiscs(const Box& box, double cell)
    : box_(box), columns_(cells_across(box.width(), cell)), rows_(cells_across(box.height(), cell)) {
    cells_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
}

template <class Found>
bool PlacedDiscs::any_cell(const Vec2& center, double radius, const Found& found) const {
    struct Cells {
        int first, last;
    };
    const auto cells = [&](double x, double length, int count) {
        const auto first = static_cast<int>(std::floor((x - radius) / length * count));
        const auto last = static_cast<int>(std::floor((x + radius) / length * count));
        if (box_.periodic) return Cells{first, std::min(last, first + count - 1)};
        return Cells{std::clamp(first, 0, count - 1), std::clamp(last, 0, count - 1)};
    };
    const Cells column = cells(center.x(), box_.width(), columns_);
    const Cells row = cells(center.y(), box_.height(), rows_);
    for (int r = row.first; r <= row.last; ++r)
        for (int c = column.first; c <= column.last; ++c) {
            const int wrapped_row = (r % rows_ + rows_) % rows_;
            const int wrapped_column = (c % columns_ + columns_) % columns_;
            if (found(static_cast<std::size_t>(wrapped_row) * static_cast<std::size_t>(columns_) +
                      static_cast<std::size_t>(wrapped_column)))
                return true;
        }
    return false;
}

void PlacedDiscs::add(const Vec2& center, double radius) {
    any_cell(center, radius, [&](std::size_t cell) {
        cells_[cell].push_back({center, radius});
        return false;
    });
}

bool PlacedDiscs::overlaps(const Vec2& center, double radius) const {
    return any_cell(center, radius, [&](std::size_t cell) {
        return std::any_of(cells_[cell].begin(), cells_[cell].end(), [&](const Disc& disc) {
            const Vec2 direct = disc.center - center;
            const Vec2 branch = box_.periodic ? box_.nearest(direct) : direct;
            const double reach = disc.radius + radius;
            return branch.squaredNorm() < reach * reach;
        });
    });
}

}  // namespace softgrain
