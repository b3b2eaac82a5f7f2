// Generated packings in periodic cells, of classes and of ellipses, examined with all pairs one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/packing/grain_classes.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/overlap.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain {
namespace {

JammedPacking jammed_cell(int count, std::uint64_t seed, double aspect_ratio = 1.0) {
    PackingSpec spec;
    spec.count = count;
    Random random(seed);
    const auto radii = draw_radii(spec, random);
    return jam(radii, {.aspect_ratio = aspect_ratio, .periodic = true}, random);
}

/// Smallest gap over all pairs and the nine cells around [m], and the number of gaps below `reach`.
struct Gaps {
    double smallest = INFINITY;
    int touching = 0;
};
Gaps gaps_of(const Packing& p, double reach) {
    Gaps gaps;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = i + 1; j < p.size(); ++j)
            for (int ix = -1; ix <= 1; ++ix)
                for (int iy = -1; iy <= 1; ++iy) {
                    const Vec2 branch =
                        p.center[j] - p.center[i] + Vec2{ix * p.box.width(), iy * p.box.height()};
                    const double gap = branch.norm() - p.radius[i] - p.radius[j];
                    gaps.smallest = std::min(gaps.smallest, gap);
                    gaps.touching += gap < reach ? 1 : 0;
                }
    return gaps;
}

TEST(CellPacking, JamsIsostatic) {
    // 2 N unknown positions less the 2 of the whole, and the cell's size: 2 N - 1 contacts.
    for (const std::uint64_t seed : {1U, 3U}) {
        const JammedPacking result = jammed_cell(80, seed, seed == 3 ? 2.0 : 1.0);
        const int carried = 80 - result.rattlers;
        EXPECT_NEAR(result.contacts, 2 * carried - 1, 2) << "seed " << seed;
        EXPECT_NEAR(result.coordination_number, 4.0 - 2.0 / carried, 0.06) << "seed " << seed;
        const Gaps gaps = gaps_of(result.packing, 1e-5);
        EXPECT_GE(gaps.smallest, -1e-13);
        EXPECT_LT(gaps.smallest, 1e-12);
        EXPECT_GE(gaps.touching, result.contacts);
        // Bidisperse and polydisperse discs without walls jam at 0.84; small cells scatter.
        EXPECT_NEAR(result.packing_fraction, 0.84, 0.02);
        for (const Vec2& c : result.packing.center) EXPECT_EQ(result.packing.box.image_of(c), Image{});
    }
}

TEST(CellPacking, ACellTooSmallForItsGrainsIsRefused) {
    try {
        jammed_cell(4, 1);
        FAIL() << "four grains cannot have a cell of their own";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("the periodic cell is too small for its grains"),
                  std::string::npos)
            << error.what();
    }
}

Scenario three_classes() {
    Scenario s;
    s.packing.count = 50;
    s.packing.packing_fraction = 0.4;
    for (const double share : {1.0, 2.0, 3.0}) s.classes.push_back({"", share, {}, 1.0});
    return s;
}

TEST(GrainClasses, NumbersFollowTheSharesAndNothingElseChanges) {
    Scenario s = three_classes();
    const Packing p = make_packing(s);
    std::vector<int> number(3, 0);
    for (std::size_t g = 0; g < p.size(); ++g) ++number.at(p.class_of(g));
    EXPECT_EQ(number, (std::vector<int>{8, 17, 25}));  // 8.33, 16.67, 25
    EXPECT_FALSE(std::is_sorted(p.grain_class.begin(), p.grain_class.end()));
    EXPECT_EQ(make_packing(s).grain_class, p.grain_class);
    EXPECT_TRUE(p.aspect_ratio.empty());

    Scenario plain = s;
    plain.classes.clear();
    const Packing without = make_packing(plain);
    EXPECT_EQ(without.center, p.center);
    EXPECT_EQ(without.radius, p.radius);
    EXPECT_TRUE(without.grain_class.empty());
    s.seed = 2;
    EXPECT_NE(make_packing(s).grain_class, p.grain_class);
}

TEST(GrainClasses, EllipsesNeverOverlap) {
    for (const bool periodic : {false, true}) {
        Scenario s = three_classes();
        s.packing.packing_fraction.reset();
        s.classes[1].aspect_ratio = 1.5;
        s.classes[2].aspect_ratio = 3.0;
        s.box.periodic = periodic;
        const Packing p = make_packing(s);
        ASSERT_EQ(p.angle.size(), p.size());
        double largest = -INFINITY;
        for (std::size_t i = 0; i < p.size(); ++i) {
            EXPECT_EQ(p.aspect_ratio[i], s.classes[p.class_of(i)].aspect_ratio);
            for (std::size_t j = i + 1; j < p.size(); ++j)
                largest = std::max(largest, relative_overlap(p, i, j));
            if (periodic) continue;
            for (int wall = 0; wall < 4; ++wall)
                EXPECT_GE(p.box.distance(wall, p.center[i]) - p.reach(i), -1e-12);
        }
        EXPECT_LE(largest, 1e-12);
        EXPECT_GT(largest, -0.2) << "discs of the same class still touch";
        // Area pi a b: the fraction is that of the grains, not of the discs around them.
        double area = 0.0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Vec2 axes = p.half_axes(i);
            EXPECT_NEAR(axes.x() / axes.y(), p.aspect_ratio[i], 1e-14);
            area += std::numbers::pi * axes.x() * axes.y();
        }
        EXPECT_NEAR(p.packing_fraction_undeformed(), area / p.box.area(), 1e-12);
        EXPECT_LT(p.packing_fraction_undeformed(), 0.6);
    }
}

TEST(GrainClasses, ThePackingFractionAskedIsThatOfTheEllipses) {
    Scenario s = three_classes();
    for (GrainClass& c : s.classes) c.aspect_ratio = 2.0;
    s.packing.packing_fraction = 0.35;
    EXPECT_NEAR(make_packing(s).packing_fraction_undeformed(), 0.35, 1e-12);
    s.packing.packing_fraction = 0.6;  // of discs with twice the area
    try {
        make_packing(s);
        FAIL() << "more than jamming";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("packing.packing_fraction 0.6 cannot be reached: these grains jam at 0.3"),
                  std::string::npos)
            << text;
    }
}

/// Against the closed forms of discs and of ellipses on their axes, and against points on the outlines.
TEST(Overlap, TouchingScaleIsWhereOutlinesMeet) {
    const auto shape = [](double a, double b, double angle) {
        const Mat2 turn =
            (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
        return Mat2(turn * Vec2(a, b).asDiagonal() * turn.transpose());
    };
    EXPECT_NEAR(touching_scale(shape(1, 1, 0), shape(0.5, 0.5, 0), {0.0, 3.0}), 2.0, 1e-12);
    EXPECT_NEAR(touching_scale(shape(2, 1, 0), shape(3, 1, 0), {4.0, 0.0}), 0.8, 1e-12);
    EXPECT_NEAR(touching_scale(shape(2, 1, 0), shape(3, 0.5, 0), {0.0, 3.0}), 2.0, 1e-12);
    Random random(3);
    for (int trial = 0; trial < 10; ++trial) {
        const Mat2 a = shape(1.0, 0.4, random.between(0.0, 3.0)),
                   b = shape(0.8, 0.3, random.between(0.0, 3.0));
        const double direction = random.between(0.0, 6.3);
        const Vec2 branch = 1.5 * Vec2{std::cos(direction), std::sin(direction)};
        const double scale = touching_scale(a, b, branch);
        // Least over the outline of b of how far a would have to grow, with b scaled by the result: 1
        // exactly.
        double least = INFINITY;
        for (int k = 0; k < 4000; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / 4000;
            const Vec2 point = branch + scale * (b * Vec2{std::cos(angle), std::sin(angle)});
            least = std::min(least, (a.inverse() * point).norm() / scale);
        }
        EXPECT_NEAR(least, 1.0, 1e-5) << "4000 points miss the touching one by 1e-6";
    }
}

}  // namespace
}  // namespace softgrain
