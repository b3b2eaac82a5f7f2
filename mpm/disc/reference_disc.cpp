#include "mpm/disc/reference_disc.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <mutex>
#include <numbers>

#include "common/errors.hpp"
#include "mpm/disc/cut_cell.hpp"
#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {
namespace {

/// A spline with less of its mass inside the disc is extrapolated.
constexpr double least_share = 0.1;
constexpr int controls_per_cell = 2;  // along the surface
constexpr int points_per_control = 8;

/// Splines and cells by their place in the grid. Cell c spans [c h, (c+1) h]; spline i is not zero on cells i
/// to i + 2.
class Grid {
  public:
    explicit Grid(int cells) : cells_(cells), side_(2 * cells + 2) {
        outer_.assign(static_cast<std::size_t>(side_ * side_), {});
    }
    int first() const { return -cells_ - 2; }
    int last() const { return cells_ - 1; }
    double h() const { return 1.0 / cells_; }
    std::size_t place(int i, int j) const {
        return static_cast<std::size_t>((j - first()) * side_ + (i - first()));
    }
    bool has(int i, int j) const { return i >= first() && i <= last() && j >= first() && j <= last(); }
    /// Greville point: where the coefficient of a linear field lies.
    double greville(int i) const { return (i + 1.5) * h(); }

    void find_unknowns();
    int unknown(int i, int j) const { return has(i, j) ? unknown_[place(i, j)] : -1; }

    struct Share {
        int node;
        double value;
    };
    /// How the coefficient of a spline follows from the unknowns.
    std::span<const Share> extension(int i, int j) const { return outer_[place(i, j)]; }

    /// N and its gradient at a point, by unknowns in ascending order.
    struct Shape {
        std::map<int, std::pair<double, Vec2>> of;
    };
    Shape shape(const Vec2& X) const;
    Shape shape(const Vec2& X, int cx, int cy) const;

    std::vector<Vec2> coordinate;

  private:
    void extend(int i, int j);

    int cells_, side_;
    std::vector<int> unknown_;
    std::vector<std::vector<Share>> outer_;
};

void Grid::find_unknowns() {
    std::vector<double> mass(outer_.size(), 0.0);
    for (int cy = -cells_; cy < cells_; ++cy)
        for (int cx = -cells_; cx < cells_; ++cx)
            for (const QuadraturePoint& q :
                 quadrature_in_disc({cx * h(), cy * h()}, {(cx + 1) * h(), (cy + 1) * h()})) {
                const SplineSpan sx = spline_span(q.position.x() / h() - cx);
                const SplineSpan sy = spline_span(q.position.y() / h() - cy);
                for (int b = 0; b < 3; ++b)
                    for (int a = 0; a < 3; ++a)
                        mass[place(cx - 2 + a, cy - 2 + b)] += q.weight *
                                                               sx.value[static_cast<std::size_t>(a)] *
                                                               sy.value[static_cast<std::size_t>(b)];
            }
    unknown_.assign(outer_.size(), -1);
    int count = 0;
    for (int j = first(); j <= last(); ++j)
        for (int i = first(); i <= last(); ++i) {
            if (mass[place(i, j)] < least_share * h() * h()) continue;
            unknown_[place(i, j)] = count;
            outer_[place(i, j)] = {{count, 1.0}};
            coordinate.emplace_back(greville(i), greville(j));
            ++count;
        }
    for (int j = first(); j <= last(); ++j)
        for (int i = first(); i <= last(); ++i)
            if (unknown(i, j) < 0 && mass[place(i, j)] > 0.0) extend(i, j);
}

/// Lagrange's parabola through three whole numbers from `from` on, at x.
std::array<double, 3> parabola(int from, int x) {
    const double t = x - from;
    return {0.5 * (t - 1.0) * (t - 2.0), t * (2.0 - t), 0.5 * t * (t - 1.0)};
}

/// From the nearest block of 3 x 3 unknowns, from all of them if several are as near.
void Grid::extend(int i, int j) {
    std::vector<std::array<int, 2>> nearest;
    int least = std::numeric_limits<int>::max();
    for (int b = first(); b <= last() - 2; ++b)
        for (int a = first(); a <= last() - 2; ++a) {
            const int distance = (a + 1 - i) * (a + 1 - i) + (b + 1 - j) * (b + 1 - j);
            if (distance > least) continue;
            bool inside = true;
            for (int k = 0; k < 9; ++k) inside = inside && unknown(a + k % 3, b + k / 3) >= 0;
            if (!inside) continue;
            if (distance < least) nearest.clear();
            least = distance;
            nearest.push_back({a, b});
        }
    std::map<int, double> sum;
    for (const auto& [a, b] : nearest) {
        const std::array<double, 3> x = parabola(a, i), y = parabola(b, j);
        for (std::size_t k = 0; k < 9; ++k)
            sum[unknown(a + static_cast<int>(k % 3), b + static_cast<int>(k / 3))] +=
                x[k % 3] * y[k / 3] / static_cast<double>(nearest.size());
    }
    for (const auto& [node, value] : sum)
        if (value != 0.0) outer_[place(i, j)].push_back({node, value});
}

Grid::Shape Grid::shape(const Vec2& X) const {
    const auto cell_of = [&](double x) {
        return std::clamp(static_cast<int>(std::floor(x / h())), -cells_, cells_ - 1);
    };
    return shape(X, cell_of(X.x()), cell_of(X.y()));
}

Grid::Shape Grid::shape(const Vec2& X, int cx, int cy) const {
    const SplineSpan sx = spline_span(X.x() / h() - cx);
    const SplineSpan sy = spline_span(X.y() / h() - cy);
    Shape shape;
    for (std::size_t b = 0; b < 3; ++b)
        for (std::size_t a = 0; a < 3; ++a) {
            const double N = sx.value[a] * sy.value[b];
            const Vec2 slope = Vec2{sx.slope[a] * sy.value[b], sx.value[a] * sy.slope[b]} / h();
            for (const Share& s : extension(cx - 2 + static_cast<int>(a), cy - 2 + static_cast<int>(b))) {
                auto& [value, gradient] = shape.of.try_emplace(s.node, 0.0, Vec2::Zero()).first->second;
                value += s.value * N;
                gradient += s.value * slope;
            }
        }
    return shape;
}

void append(ShapeRows& rows, const Grid::Shape& shape) {
    for (const auto& [node, value] : shape.of) {
        rows.node.push_back(node);
        rows.value.push_back(value.first);
    }
    rows.start.push_back(static_cast<int>(rows.node.size()));
}

Vec2 on_circle(double radius, double turn) {
    const double angle = 2.0 * std::numbers::pi * turn;
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

}  // namespace

ReferenceDisc::ReferenceDisc(int cells_across) : cells(cells_across) {
    if (cells < 2 || cells > 64)
        throw InputError(fmt::format("a grain of {} grid cells across its radius; use 2 to 64", cells));
    Grid grid(cells);
    grid.find_unknowns();
    coordinate = grid.coordinate;
    const double h = spacing();
    for (int cy = -cells; cy < cells; ++cy)
        for (int cx = -cells; cx < cells; ++cx) {
            const auto quadrature = quadrature_in_disc({cx * h, cy * h}, {(cx + 1) * h, (cy + 1) * h});
            if (quadrature.empty()) continue;
            Cell c{static_cast<int>(cell_node.size()), 0, static_cast<int>(weight.size()),
                   static_cast<int>(quadrature.size()), static_cast<int>(gradient.size())};
            for (const QuadraturePoint& q : quadrature) {
                const Grid::Shape shape = grid.shape(q.position, cx, cy);
                if (c.nodes == 0) {
                    c.nodes = static_cast<int>(shape.of.size());
                    for (const auto& entry : shape.of) cell_node.push_back(entry.first);
                }
                for (const auto& entry : shape.of) gradient.push_back(entry.second.second);
                append(at_points, shape);
                weight.push_back(q.weight);
            }
            cell.push_back(c);
        }
    integral.assign(nodes(), 0.0);
    for (std::size_t p = 0; p < points(); ++p)
        for (std::size_t k = 0; k < at_points.nodes(p).size(); ++k)
            integral[static_cast<std::size_t>(at_points.nodes(p)[k])] += weight[p] * at_points.values(p)[k];
    // A multiple of 8 keeps the symmetry of the grid.
    const int controls =
        8 * static_cast<int>(std::ceil(2.0 * std::numbers::pi * cells * controls_per_cell / 8.0));
    const double half_angle = std::numbers::pi / controls;
    const double outside = 1.0 / (1.0 - 0.5 * std::pow(std::sin(half_angle), 2));
    for (int k = 0; k < controls; ++k) append(control, grid.shape(on_circle(outside, (k + 0.5) / controls)));
    const int surface_points = controls * points_per_control;
    for (int k = 0; k < surface_points; ++k)
        append(surface, grid.shape(on_circle(1.0, (k + 0.5) / surface_points)));
}

double ReferenceDisc::surface_weight() const {
    return 2.0 * std::numbers::pi / static_cast<double>(surface.size());
}

std::shared_ptr<const ReferenceDisc> reference_disc(int cells) {
    static std::mutex guard;
    static std::map<int, std::shared_ptr<const ReferenceDisc>> made;
    const std::lock_guard lock(guard);
    auto& disc = made[cells];
    if (!disc) disc = std::make_shared<const ReferenceDisc>(cells);
    return disc;
}

}  // namespace softgrain::mpm
