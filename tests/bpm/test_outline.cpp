#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <numbers>
#include <random>

#include "bpm/aggregate.hpp"
#include "bpm/outline.hpp"
#include "tests/bpm/alpha_complex.hpp"

namespace softgrain::bpm {
namespace {

std::vector<Pair> all_pairs(std::size_t n) {
    std::vector<Pair> pairs;
    for (int i = 0; i < static_cast<int>(n); ++i)
        for (int j = i + 1; j < static_cast<int>(n); ++j) pairs.push_back({i, j});
    return pairs;
}

/// Area of the closing on a grid of points: a point is outside if some point farther than rho from all discs
/// is nearer than rho.
double closing_on_a_grid(const std::vector<Vec2>& x, const std::vector<double>& radius, double rho,
                         double cell) {
    Vec2 low = x[0], high = x[0];
    for (std::size_t d = 0; d < x.size(); ++d) {
        low = low.cwiseMin(x[d] - Vec2::Constant(radius[d] + 3.0 * rho));
        high = high.cwiseMax(x[d] + Vec2::Constant(radius[d] + 3.0 * rho));
    }
    const int nx = static_cast<int>((high.x() - low.x()) / cell),
              ny = static_cast<int>((high.y() - low.y()) / cell);
    const auto place = [&](int i, int j) {
        return Vec2(low.x() + (i + 0.5) * cell, low.y() + (j + 0.5) * cell);
    };
    std::vector<char> open(static_cast<std::size_t>(nx * ny)), outside(open.size(), 0);
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            bool is_open = true;
            for (std::size_t d = 0; d < x.size() && is_open; ++d)
                is_open = (place(i, j) - x[d]).norm() > radius[d] + rho;
            open[static_cast<std::size_t>(j * nx + i)] = is_open;
        }
    const int reach = static_cast<int>(rho / cell) + 1;
    for (int j = 0; j < ny; ++j)
        for (int i = 0; i < nx; ++i) {
            const auto is_open = [&](int a, int b) {
                return a < 0 || b < 0 || a >= nx || b >= ny || open[static_cast<std::size_t>(b * nx + a)];
            };
            if (!is_open(i, j)) continue;
            outside[static_cast<std::size_t>(j * nx + i)] = 1;
            if (is_open(i - 1, j) && is_open(i + 1, j) && is_open(i, j - 1) && is_open(i, j + 1)) continue;
            for (int b = -reach; b <= reach; ++b)
                for (int a = -reach; a <= reach; ++a)
                    if (i + a >= 0 && i + a < nx && j + b >= 0 && j + b < ny &&
                        std::hypot(a * cell, b * cell) < rho)
                        outside[static_cast<std::size_t>((j + b) * nx + i + a)] = 1;
        }
    double area = 0.0;
    for (char is_outside : outside) area += is_outside ? 0.0 : cell * cell;
    return area;
}

bool inside(std::span<const Vec2> polygon, const Vec2& p) {
    bool in = false;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2& a = polygon[k];
        const Vec2& b = polygon[(k + 1) % polygon.size()];
        if ((a.y() > p.y()) != (b.y() > p.y()) &&
            p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
            in = !in;
    }
    return in;
}

TEST(Outline, OneDisc) {
    const std::vector<Vec2> x{{3.0, -2.0}};
    const std::vector<double> radius{0.7};
    const Outline outline(x, radius, 0.2, {});
    EXPECT_NEAR(outline.area(), std::numbers::pi * 0.49, 1e-12);
}

TEST(Outline, TwoTouchingDiscsClosedForm) {
    // Between two unit discs that touch, a disc of radius rho rests on both: the fillets on both sides add
    // 2 (triangle of the three centres - its sectors).
    const double rho = 0.5;
    const std::vector<Vec2> x{{0, 0}, {2, 0}};
    const std::vector<double> radius{1, 1};
    const double height = std::sqrt((1 + rho) * (1 + rho) - 1);
    const double angle = std::acos(1 / (1 + rho));  // at each disc
    const double fillet = height - angle - 0.5 * rho * rho * (std::numbers::pi - 2 * angle);
    const Outline outline(x, radius, rho, all_pairs(2));
    EXPECT_NEAR(outline.area(), 2 * std::numbers::pi + 2 * fillet, 1e-12);
}

TEST(Outline, NarrowNeckDoesNotCountTwice) {
    // Discs 0.85 apart with rho = 0.5: the two fillets would overlap at the waist.
    const std::vector<Vec2> x{{0, 0}, {2.85, 0}};
    const std::vector<double> radius{1, 1};
    const double grid = closing_on_a_grid(x, radius, 0.5, 0.008);
    EXPECT_NEAR(Outline(x, radius, 0.5, all_pairs(2)).area(), grid, 0.006 * grid);
}

TEST(Outline, HoleIsNotCounted) {
    // A ring of 8 discs around a pore that rho can enter, and the same ring with rho too large to enter.
    std::vector<Vec2> x;
    const double ring = 1.0 / std::sin(std::numbers::pi / 8.0);
    for (int k = 0; k < 8; ++k)
        x.emplace_back(ring * std::cos(k * std::numbers::pi / 4), ring * std::sin(k * std::numbers::pi / 4));
    const std::vector<double> radius(8, 1.0);
    for (double rho : {0.3, 1.0, 1.7}) {
        const double grid = closing_on_a_grid(x, radius, rho, 0.015);
        EXPECT_NEAR(Outline(x, radius, rho, all_pairs(8)).area(), grid, 0.01 * grid) << rho;
    }
}

TEST(Outline, EqualsClosingOnAGrid) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int trial = 0; trial < 4; ++trial) {
        // Loose clusters: pores, necks and separate pieces of all kinds.
        std::vector<Vec2> x;
        std::vector<double> radius;
        for (int k = 0; k < 25; ++k) {
            x.emplace_back(5.5 * unit(random), 5.5 * unit(random));
            radius.push_back(0.35 + 0.25 * unit(random));
        }
        const double grid = closing_on_a_grid(x, radius, 0.3, 0.005);
        // 0.6 %: half a cell along a rim of about 25 is 0.4 %; rare pinched pores.
        EXPECT_NEAR(Outline(x, radius, 0.3, all_pairs(25)).area(), grid, 0.006 * grid) << trial;
    }
}

TEST(Outline, PolygonEnclosesEveryDiscOfAGrain) {
    const Aggregate grain = prepare_aggregate({.discs = 80, .seed = 2});
    double diameter = 0.0;
    for (double r : grain.radius) diameter += 2.0 * r / 80.0;
    const Outline outline(grain.x, grain.radius, 0.3 * diameter, all_pairs(80));
    std::vector<Vec2> polygon;
    outline.append_polygon(0, 80, polygon);
    for (std::size_t d = 0; d < 80; ++d) {
        EXPECT_TRUE(inside(polygon, grain.x[d]));
        // Points just inside the rim: corners lie on the rim up to 20 degrees apart, sagitta 1.5 % of the
        // radius.
        for (int k = 0; k < 12; ++k) {
            const double angle = k * std::numbers::pi / 6;
            EXPECT_TRUE(inside(polygon,
                               grain.x[d] + 0.98 * grain.radius[d] * Vec2(std::cos(angle), std::sin(angle))));
        }
    }
    EXPECT_NEAR(polygon_area(polygon), outline.area(), 0.005 * outline.area());
}

TEST(Outline, TouchingGrainsHaveTouchingOutlines) {
    // Two discs of different grains that touch at the origin: both outlines pass through the origin.
    const std::vector<Vec2> x{{-1.0, 0.0}, {-2.6, 1.0}, {1.0, 0.0}, {2.6, -1.0}};
    const std::vector<double> radius{1.0, 0.9, 1.0, 0.9};
    const Outline outline(x, radius, 0.3, std::vector<Pair>{{0, 1}, {2, 3}});
    std::vector<Vec2> left, right;
    outline.append_polygon(0, 2, left);
    outline.append_polygon(2, 4, right);
    double left_most = -10.0, right_most = 10.0;
    for (const Vec2& p : left) left_most = std::max(left_most, p.x());
    for (const Vec2& p : right) right_most = std::min(right_most, p.x());
    // Sagitta of 20 degrees on a unit disc: 1.5 %.
    EXPECT_NEAR(left_most, 0.0, 0.016);
    EXPECT_NEAR(right_most, 0.0, 0.016);
    EXPECT_LE(left_most, right_most + 1e-12);
}

/// n discs of radius 0.35 to 0.6 in a square, none overlapping another.
void throw_discs(std::size_t n, double side, unsigned seed, std::vector<Vec2>& x,
                 std::vector<double>& radius) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    while (x.size() < n) {
        const Vec2 at{side * unit(random), side * unit(random)};
        const double r = 0.35 + 0.25 * unit(random);
        bool free = true;
        for (std::size_t k = 0; k < x.size() && free; ++k) free = (x[k] - at).norm() > radius[k] + r;
        if (!free) continue;
        x.push_back(at);
        radius.push_back(r);
    }
}

TEST(AlphaComplex, ThreeDiscsAreATriangleUntilRhoCanEnter) {
    const double side = 2.2, rho = side / std::sqrt(3.0) - 1.0;  // of the disc between three unit discs
    const std::vector<Vec2> x{{0, 0}, {side, 0}, {0.5 * side, 0.5 * std::sqrt(3.0) * side}};
    const std::vector<double> radius(3, 1.0);
    const double triangle = 0.25 * std::sqrt(3.0) * side * side;
    EXPECT_NEAR(alpha_complex(x, radius, 1.001 * rho).area(), triangle + 2.5 * std::numbers::pi, 1e-12);
    EXPECT_NEAR(alpha_complex(x, radius, 0.999 * rho).area(), 3.0 * std::numbers::pi, 1e-12);
}

/// The closing is the alpha complex of the weighted Delaunay triangulation with the discs around it, and
/// hollow fillets in all crevices: an identity, however loose the discs lie.
TEST(Outline, IsTheAlphaComplexWithFillets) {
    for (unsigned seed : {1U, 2U, 3U, 4U}) {
        std::vector<Vec2> x;
        std::vector<double> radius;
        throw_discs(60, 9.0, seed, x, radius);
        for (double rho : {0.1, 0.2, 0.3, 0.5}) {
            const AlphaComplex complex = alpha_complex(x, radius, rho);
            EXPECT_NEAR(Outline(x, radius, rho, all_pairs(60)).area(),
                        complex.area() + fillets(x, radius, rho), 1e-10)
                << "seed " << seed << ", rho " << rho << ", " << complex.triangles.size() << " triangles";
        }
    }
}

/// How much area the outline of a grain has beyond the complex: the crevices of its rim.
TEST(Outline, CountsCrevicesThatTheAlphaComplexDoesNot) {
    const Aggregate grain = prepare_aggregate({.discs = 100, .seed = 2});
    double diameter = 0.0;
    for (double r : grain.radius) diameter += 2.0 * r / 100.0;
    const double rho = 0.3 * diameter;
    const AlphaComplex complex = alpha_complex(grain.x, grain.radius, rho);
    const double area = Outline(grain.x, grain.radius, rho, all_pairs(100)).area();
    // Overlaps of 1e-4 diameters are counted twice by the complex: 1e-6 of a disc each.
    EXPECT_NEAR(area, complex.area() + fillets(grain.x, grain.radius, rho), 1e-5);
    // A crevice between equal discs is 0.028 diameters^2; about 35 of them on 92 diameters^2.
    EXPECT_GT(area / complex.area(), 1.005);
    EXPECT_LT(area / complex.area(), 1.02);
}

/// Two grains pushed into each other: the outline of both together, with and without that of each.
TEST(Outline, DiscsHiddenInTheirGrainNeedNoSecondLook) {
    const Aggregate grain = prepare_aggregate({.discs = 60, .seed = 3});
    std::vector<Vec2> x = grain.x;
    std::vector<double> radius = grain.radius;
    for (std::size_t d = 0; d < 60; ++d) {
        x.push_back(grain.x[d] + Vec2{1.8, 0.2});
        radius.push_back(grain.radius[d]);
    }
    std::vector<Pair> within;
    for (const Pair& pair : all_pairs(120))
        if ((pair.i < 60) == (pair.j < 60)) within.push_back(pair);
    const double rho = 0.05;
    const Outline apart(x, radius, rho, within);
    const Outline both(x, radius, rho, all_pairs(120)), quick(x, radius, rho, all_pairs(120), &apart);
    EXPECT_LT(both.area(), apart.area(0, 60) + apart.area(60, 120) - 0.01);
    ASSERT_EQ(quick.arcs().size(), both.arcs().size());
    for (std::size_t k = 0; k < both.arcs().size(); ++k) {
        EXPECT_EQ(quick.arcs()[k].disc, both.arcs()[k].disc);
        EXPECT_EQ(quick.arcs()[k].begin, both.arcs()[k].begin);
        EXPECT_EQ(quick.arcs()[k].end, both.arcs()[k].end);
    }
}

/// So many discs that threads share them: a lattice of grid cells with a disc somewhere in each.
TEST(Outline, TwoThreadsGiveTheArcsOfOne) {
    constexpr int columns = 83, rows = 75;
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<Vec2> x;
    std::vector<double> radius;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            x.emplace_back(column + 0.3 * unit(random), row + 0.3 * unit(random));
            radius.push_back(0.35 + 0.1 * unit(random));
        }
    const double rho = 0.15;
    NeighborList near;
    near.build(x, radius, 2.0 * rho);
    const auto arcs_by = [&](int threads) {
        const int before = omp_get_max_threads();
        omp_set_num_threads(threads);
        const Outline outline(x, radius, rho, near.pairs());
        omp_set_num_threads(before);
        return std::vector<ExposedArc>(outline.arcs().begin(), outline.arcs().end());
    };
    const std::vector<ExposedArc> one = arcs_by(1), two = arcs_by(2);
    EXPECT_GT(one.size(), x.size() / 2);
    ASSERT_EQ(one.size(), two.size());
    for (std::size_t k = 0; k < one.size(); ++k) {
        const ExposedArc &a = one[k], &b = two[k];
        EXPECT_TRUE(a.disc == b.disc && a.begin == b.begin && a.end == b.end && a.before == b.before &&
                    a.after == b.after && a.neck == b.neck)
            << "arc " << k << " of disc " << a.disc;
        EXPECT_LE(one[k > 0 ? k - 1 : 0].disc, a.disc);
    }
}

}  // namespace
}  // namespace softgrain::bpm
