// Delaunay triangles against their definition, and strains and voids against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/observables/tessellation.hpp"
#include "common/packing/random.hpp"

namespace softgrain {
namespace {

std::vector<Vec2> scattered(int n, std::uint64_t seed, double width = 1.0, double height = 1.0) {
    Random random(seed);
    std::vector<Vec2> points;
    for (int k = 0; k < n; ++k) {
        const double x = random.between(0.0, width);
        points.emplace_back(x, random.between(0.0, height));
    }
    return points;
}

std::vector<Vec2> lattice(int columns, int rows) {
    std::vector<Vec2> points;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) points.emplace_back(x, y);
    return points;
}

double total_area(const Tessellation& t, const std::vector<Vec2>& x, const Box& box) {
    double area = 0.0;
    for (std::size_t k = 0; k < t.triangles.size(); ++k) area += triangle_area(t.corners(k, x, box));
    return area;
}

/// Hull by Andrew's chain, counter-clockwise.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
    std::sort(points.begin(), points.end(),
              [](const Vec2& a, const Vec2& b) { return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y()); });
    std::vector<Vec2> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const Vec2& p : points) {
            while (hull.size() >= start + 2 &&
                   cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0)
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

TEST(Delaunay, NoPointLiesInTheCircleOfATriangle) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const auto points = scattered(150, seed, 3.0);
        const auto triangles = delaunay(points);
        for (const Triangle& t : triangles) {
            const auto corner = [&](std::size_t k) { return points[static_cast<std::size_t>(t[k])]; };
            Mat2 rows;
            rows << (corner(1) - corner(0)).transpose(), (corner(2) - corner(0)).transpose();
            EXPECT_GT(rows.determinant(), 0.0);
            const Vec2 from_first = rows.inverse() * Vec2(0.5 * (corner(1) - corner(0)).squaredNorm(),
                                                          0.5 * (corner(2) - corner(0)).squaredNorm());
            const Vec2 middle = corner(0) + from_first;
            for (const Vec2& p : points)  // points were rounded to 3e-9
                EXPECT_GE((p - middle).norm(), from_first.norm() * (1.0 - 1e-5));
        }
        // Euler: all of the hull, each triangle once.
        const auto hull = hull_of(points);
        EXPECT_EQ(triangles.size(), 2 * points.size() - 2 - hull.size());
        double hull_area = 0.0;
        for (std::size_t k = 0; k < hull.size(); ++k)
            hull_area += 0.5 * cross(hull[k], hull[(k + 1) % hull.size()]);
        EXPECT_NEAR(total_area(tessellate(points, {}), points, {}), hull_area, 1e-12);
    }
}

TEST(Delaunay, LatticesLinesAndEqualPoints) {
    // Four on every circle, and many on the lines of the hull.
    const auto square = lattice(7, 5);
    EXPECT_EQ(delaunay(square).size(), 2U * 6U * 4U);
    EXPECT_NEAR(total_area(tessellate(square, {}), square, {}), 24.0, 1e-12);
    EXPECT_TRUE(delaunay(lattice(9, 1)).empty());
    EXPECT_TRUE(delaunay(lattice(2, 1)).empty());
    auto twice = square;
    twice.insert(twice.end(), square.begin(), square.end());
    EXPECT_EQ(delaunay(twice).size(), 2U * 6U * 4U);
    EXPECT_TRUE(delaunay(std::vector<Vec2>(5, Vec2(1.0, 2.0))).empty());
    // A wheel: all on one circle but the hub.
    std::vector<Vec2> wheel{{0.0, 0.0}};
    for (int k = 0; k < 12; ++k)
        wheel.emplace_back(std::cos(k * std::numbers::pi / 6.0), std::sin(k * std::numbers::pi / 6.0));
    EXPECT_EQ(delaunay(wheel).size(), 12U);
}

TEST(Tessellation, ThePeriodicCellIsCoveredOnce) {
    for (const double tilt : {0.0, 0.4, 5.3, 700.0}) {
        const Box cell{{0.5, 2.5, -1.0, 0.5}, true, tilt};
        for (const int n : {3, 20, 300}) {
            auto points = scattered(n, 4, 2.0, 1.5);
            points[0] += cell.image(2, -1);  // outside
            const Tessellation t = tessellate(points, cell);
            EXPECT_EQ(t.triangles.size(), 2U * static_cast<std::size_t>(n));
            EXPECT_NEAR(total_area(t, points, cell), cell.area(), 1e-12) << "tilt " << tilt << ", " << n;
            for (std::size_t k = 0; k < t.triangles.size(); ++k)
                EXPECT_GT(triangle_area(t.corners(k, points, cell)), 0.0);
        }
    }
    // Four on every circle here as well.
    const Box square{{0.0, 6.0, 0.0, 5.0}, true};
    const auto points = lattice(6, 5);
    EXPECT_NEAR(total_area(tessellate(points, square), points, square), 30.0, 1e-12);
    // Neighbours further away than the next copy of the cell.
    EXPECT_THROW(tessellate(lattice(2, 1), Box{{0.0, 40.0, 0.0, 1.0}, true, 15.0}), InputError);
}

TEST(Tessellation, AnAffineStrainIsFoundInEveryTriangle) {
    const Mat2 imposed = (Mat2() << 0.97, 0.05, -0.02, 0.93).finished();
    const auto before = scattered(400, 5, 2.0);
    std::vector<Vec2> now;
    for (const Vec2& x : before) now.push_back(imposed * x + Vec2(3.0, -1.0));
    const Tessellation t = tessellate(before, {});
    const auto gradients = local_gradients(t, before, {}, now, {});
    ASSERT_EQ(gradients.size(), t.triangles.size());
    for (std::size_t k = 0; k < gradients.size(); ++k) {
        // Rounding of positions of order 3 over the triangle's height.
        const auto corners = t.corners(k, before, {});
        double longest = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            longest = std::max(longest, (corners[(c + 1) % 3] - corners[c]).norm());
        const double height = 2.0 * triangle_area(corners) / longest;
        EXPECT_NEAR((gradients[k] - imposed).norm(), 0.0, 1e-14 / height);
    }
    EXPECT_NEAR((mean_gradient(t, before, {}, now, {}) - imposed).norm(), 0.0, 1e-12);
}

TEST(Tessellation, TheMeanIsThatOfTheBoundaryWhateverHappensInside) {
    // Points of the hull move by the strain, those within anywhere.
    const Mat2 imposed = (Mat2() << 0.9, 0.1, 0.0, 1.05).finished();
    auto before = lattice(6, 6);
    const auto inner = scattered(100, 6, 4.9, 4.9);
    for (const Vec2& x : inner) before.push_back(x + Vec2(0.05, 0.05));
    std::vector<Vec2> now;
    Random random(7);
    for (const Vec2& x : before) {
        const bool rim = x.x() == 0.0 || x.y() == 0.0 || x.x() == 5.0 || x.y() == 5.0;
        const double dx = random.between(-0.3, 0.3);
        now.push_back(imposed * x + (rim ? Vec2(0.0, 0.0) : Vec2(dx, random.between(-0.3, 0.3))));
    }
    const Tessellation t = tessellate(before, {});
    EXPECT_NEAR((mean_gradient(t, before, {}, now, {}) - imposed).norm(), 0.0, 1e-12);
    const auto local = local_gradients(t, before, {}, now, {});
    EXPECT_GT((local[50] - imposed).norm(), 1e-3);
}

TEST(Tessellation, TheMeanOfACellIsThatOfItsLatticeVectors) {
    const Box before{{0.0, 2.0, 0.0, 1.0}, true, 0.3}, now{{0.0, 1.8, 0.0, 1.1}, true, 2.5};
    const auto x = scattered(60, 8, 2.0);
    auto moved = x;
    Random random(9);
    for (Vec2& p : moved) {
        p = now.lattice() * before.lattice().inverse() * p;
        p.x() += random.between(-0.1, 0.1);
    }
    const Mat2 imposed = now.lattice() * before.lattice().inverse();
    const Tessellation t = tessellate(x, before);
    EXPECT_NEAR((mean_gradient(t, x, before, moved, now) - imposed).norm(), 0.0, 1e-12);
}

TEST(Tessellation, VoidRatiosOfLatticesOfDiscs) {
    // Touching discs: 4 / pi - 1 on a square lattice, 2 sqrt(3) / pi - 1 on a hexagonal one.
    const std::vector<double> area(36, std::numbers::pi / 4.0);
    const auto square = lattice(6, 6);
    for (const double e : void_ratios(tessellate(square, {}), square, {}, area))
        EXPECT_NEAR(e, 4.0 / std::numbers::pi - 1.0, 1e-12);
    std::vector<Vec2> hexagonal;
    for (const Vec2& x : square)
        hexagonal.emplace_back(x.x() + 0.5 * x.y(), 0.5 * std::numbers::sqrt3 * x.y());
    for (const double e : void_ratios(tessellate(hexagonal, {}), hexagonal, {}, area))
        EXPECT_NEAR(e, 2.0 * std::numbers::sqrt3 / std::numbers::pi - 1.0, 1e-12);
}

TEST(Tessellation, VoidRatiosAddUpToThatOfTheCell) {
    const Box cell{{0.0, 2.0, 0.0, 1.0}, true, 0.3};
    const auto x = scattered(80, 10, 2.0);
    std::vector<double> area;
    Random random(11);
    double solid = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        area.push_back(random.between(0.005, 0.02));
        solid += area.back();
    }
    const Tessellation t = tessellate(x, cell);
    const auto e = void_ratios(t, x, cell, area);
    double sum = 0.0;
    for (std::size_t k = 0; k < e.size(); ++k) sum += triangle_area(t.corners(k, x, cell)) / (1.0 + e[k]);
    EXPECT_NEAR(sum, solid, 1e-12);
}

}  // namespace
}  // namespace softgrain
