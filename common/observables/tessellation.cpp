#include "common/observables/tessellation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr double flat = 1e-9;     // height / length of a triangle that is left out
constexpr double covered = 1e-6;  // relative error of the area of a cell, by rounding to the grid
constexpr int copies = 9;         // of the cell, itself the first

CellOffset copy_of_cell(int copy) {
    const int k = (copy + 4) % copies;  // 0 is the middle one
    return {k % 3 - 1, k / 3 - 1};
}

/// The copy that x lies in, however far away.
CellOffset offset_of(const Vec2& x, const Box& cell) {
    const Vec2 d = x - cell.origin();
    const double row = d.y() / cell.height();
    return {static_cast<int>(std::floor((d.x() - cell.tilt * row) / cell.width())),
            static_cast<int>(std::floor(row))};
}

/// A few grid units by grain, the same in all copies, so that no four centres lie on a circle.
GridPoint nudge(std::size_t grain) {
    std::uint64_t mixed = (grain + 1) * 0x9E3779B97F4A7C15U;
    mixed ^= mixed >> 29U;
    mixed *= 0xBF58476D1CE4E5B9U;
    mixed ^= mixed >> 32U;
    return {static_cast<std::int64_t>(mixed & 63U), static_cast<std::int64_t>((mixed >> 6U) & 63U)};
}

/// All copies of all grains on the grid; exact copies, so that the triangles of one cell repeat in the next.
std::vector<GridPoint> grid_copies(std::span<const Vec2> position, const Box& cell) {
    const double across = 3.0 * (cell.width() + std::abs(cell.tilt)) + 3.0 * cell.height();
    const double scale = 0.99 * static_cast<double>(grid_extent) / across;
    const auto on_grid = [&](double x) { return static_cast<std::int64_t>(std::llround(scale * x)); };
    const std::int64_t width = on_grid(cell.width()), tilt = on_grid(cell.tilt),
                       height = on_grid(cell.height());
    std::vector<GridPoint> grid;
    for (int copy = 0; copy < copies; ++copy) {
        const CellOffset image = copy_of_cell(copy);
        for (std::size_t g = 0; g < position.size(); ++g) {
            const CellOffset beyond = offset_of(position[g], cell);
            const Vec2 inside = position[g] - cell.image(beyond.x, beyond.y) - cell.origin();
            const GridPoint off = nudge(g);
            grid.push_back({on_grid(inside.x()) + off.x + image.x * width + image.y * tilt,
                            on_grid(inside.y()) + off.y + image.y * height});
        }
    }
    return grid;
}

Tessellation of_cell(std::span<const Vec2> position, const Box& box) {
    const int flips = box.flips();
    const Box cell = box.flipped(flips);
    const auto n = static_cast<int>(position.size());
    Tessellation result;
    for (const Triangle& triangle : delaunay(grid_copies(position, cell))) {
        // One of the copies of a triangle: the one whose first corner, by grain and copy, lies in the cell.
        const auto key = [&](int point) {
            const CellOffset image = copy_of_cell(point / n);
            return std::tuple(point % n, image.x, image.y);
        };
        const int first = *std::min_element(triangle.begin(), triangle.end(),
                                            [&](int a, int b) { return key(a) < key(b); });
        if (first >= n) continue;
        Triangle grains{};
        std::array<CellOffset, 3> offsets;
        for (std::size_t k = 0; k < 3; ++k) {
            grains[k] = triangle[k] % n;
            const CellOffset copy = copy_of_cell(triangle[k] / n);
            const CellOffset beyond = offset_of(position[static_cast<std::size_t>(grains[k])], cell);
            const int row = copy.y - beyond.y;
            offsets[k] = {copy.x - beyond.x - row * flips, row};
        }
        result.triangles.push_back(grains);
        result.offsets.push_back(offsets);
    }
    double area = 0.0;
    for (std::size_t t = 0; t < result.triangles.size(); ++t)
        area += triangle_area(result.corners(t, position, box));
    if (!(std::abs(area - box.area()) < covered * box.area()))
        throw InputError(fmt::format("{} grains are too few to tessellate their periodic cell", n));
    return result;
}

Mat2 sides(const std::array<Vec2, 3>& corners) {
    Mat2 columns;
    columns << corners[1] - corners[0], corners[2] - corners[0];
    return columns;
}

}  // namespace

std::array<Vec2, 3> Tessellation::corners(std::size_t triangle, std::span<const Vec2> position,
                                          const Box& box) const {
    std::array<Vec2, 3> all;
    for (std::size_t k = 0; k < 3; ++k) {
        all[k] = position[static_cast<std::size_t>(triangles[triangle][k])];
        if (!offsets.empty()) all[k] += box.image(offsets[triangle][k].x, offsets[triangle][k].y);
    }
    return all;
}

double triangle_area(const std::array<Vec2, 3>& corners) {
    return 0.5 * cross(corners[1] - corners[0], corners[2] - corners[0]);
}

Tessellation tessellate(std::span<const Vec2> position, const Box& box) {
    if (box.periodic) return of_cell(position, box);
    Tessellation result{delaunay(position), {}};
    std::vector<Triangle> kept;
    for (std::size_t t = 0; t < result.triangles.size(); ++t) {
        const auto corners = result.corners(t, position, box);
        double longest = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            longest = std::max(longest, (corners[(k + 1) % 3] - corners[k]).squaredNorm());
        if (2.0 * triangle_area(corners) > flat * longest) kept.push_back(result.triangles[t]);
    }
    result.triangles = std::move(kept);
    return result;
}

std::vector<Mat2> local_gradients(const Tessellation& tessellation, std::span<const Vec2> reference,
                                  const Box& reference_box, std::span<const Vec2> position, const Box& box) {
    std::vector<Mat2> gradients;
    for (std::size_t t = 0; t < tessellation.triangles.size(); ++t) {
        const Mat2 before = sides(tessellation.corners(t, reference, reference_box));
        const Mat2 now = sides(tessellation.corners(t, position, box));
        gradients.push_back(before.determinant() != 0.0
                                ? Mat2(now * before.inverse())
                                : Mat2::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
    return gradients;
}

Mat2 mean_gradient(const Tessellation& tessellation, std::span<const Vec2> reference,
                   const Box& reference_box, std::span<const Vec2> position, const Box& box) {
    // Area times gradient without division: now * adjugate(before) / 2.
    Mat2 sum = Mat2::Zero();
    double area = 0.0;
    for (std::size_t t = 0; t < tessellation.triangles.size(); ++t) {
        const Mat2 before = sides(tessellation.corners(t, reference, reference_box));
        const Mat2 adjugate = (Mat2() << before(1, 1), -before(0, 1), -before(1, 0), before(0, 0)).finished();
        sum += 0.5 * sides(tessellation.corners(t, position, box)) * adjugate;
        area += 0.5 * before.determinant();
    }
    return sum / area;
}

std::vector<double> void_ratios(const Tessellation& tessellation, std::span<const Vec2> position,
                                const Box& box, std::span<const double> reference_area) {
    std::vector<double> ratios;
    for (std::size_t t = 0; t < tessellation.triangles.size(); ++t) {
        const auto corners = tessellation.corners(t, position, box);
        double solid = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2 a = corners[(k + 1) % 3] - corners[k], b = corners[(k + 2) % 3] - corners[k];
            const double angle = std::atan2(std::abs(cross(a, b)), a.dot(b));
            const auto grain = static_cast<std::size_t>(tessellation.triangles[t][k]);
            solid += reference_area[grain] * angle / (2.0 * std::numbers::pi);
        }
        ratios.push_back(triangle_area(corners) / solid - 1.0);
    }
    return ratios;
}

}  // namespace softgrain
