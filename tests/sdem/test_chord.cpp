// Exact chord of two ellipses against a long double bisection and against the paper's polygons.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "random_ellipses.hpp"
#include "sdem/geometry/chord.hpp"
#include "sdem/geometry/polygon_reference.hpp"

namespace softgrain::sdem {
namespace {

using test::long_chord;
using test::LongChord;
using test::RandomPair;

double relative(double value, long double expected) {
    return static_cast<double>(std::abs(static_cast<long double>(value) / expected - 1.0L));
}

/// Largest relative error over all quantities of the chord.
double largest_error(const Chord& c, const LongChord& e) {
    const double sine =
        std::abs(c.normal.x() * static_cast<double>(e.ny) - c.normal.y() * static_cast<double>(e.nx));
    const double middle = std::hypot(c.point.x() - static_cast<double>((e.p.x + e.q.x) / 2),
                                     c.point.y() - static_cast<double>((e.p.y + e.q.y) / 2));
    return std::max({relative(c.length, e.length), relative(c.depth_i, e.depth_i),
                     relative(c.depth_j, e.depth_j), relative(c.cap_i, e.cap_i), relative(c.cap_j, e.cap_j),
                     sine, middle});
}

TEST(Unit, OfAGuessInSinglePrecisionHasLengthOne) {
    double worst = 0.0;
    for (int k = 0; k < 1000; ++k) {
        const float x = std::cos(0.00628F * static_cast<float>(k)),
                    y = std::sin(0.00628F * static_cast<float>(k));
        const detail::Unit u(Vec2{static_cast<double>(x), static_cast<double>(y)});
        const long double square = static_cast<long double>(u.x) * u.x + static_cast<long double>(u.y) * u.y;
        worst = std::max(worst, static_cast<double>(std::abs(square - 1.0L)));
    }
    EXPECT_LT(worst, 5e-16);  // rounding of the two components
}

struct Level {
    double depth;  ///< |delta_n| / R of the smaller grain
    double strain;
    int pairs;
    double tolerance;
};
class ChordAgainstLongDouble : public testing::TestWithParam<Level> {};

// The conditioning of the problem is eps / depth: the tolerance follows it.
TEST_P(ChordAgainstLongDouble, EveryQuantity) {
    const auto [depth, strain, pairs, tolerance] = GetParam();
    std::mt19937_64 random(7);
    double worst = 0.0;
    for (int k = 0; k < pairs; ++k) {
        const RandomPair pair(random, strain, 0.3);
        const Ellipse j = pair.j(2.0 * depth * pair.R_j);
        const LongChord expected = long_chord(pair.i, j);
        ASSERT_EQ(expected.crossings, 2);
        WarmStart deepest;
        const Chord cold = chord_of(pair.i, j, deepest);
        ASSERT_EQ(cold.overlap, Overlap::chord) << "pair " << k;
        EXPECT_GT(cold.normal.dot(j.center - pair.i.center), 0.0);
        worst = std::max(worst, largest_error(cold, expected));
        const Chord warm = chord_of(pair.i, j, deepest);
        worst = std::max(worst, largest_error(warm, expected));
        WarmStart other;
        const Chord swapped = chord_of(j, pair.i, other);
        EXPECT_NEAR((swapped.normal + cold.normal).norm(), 0.0, tolerance);
        EXPECT_NEAR(swapped.depth_j, cold.depth_i, tolerance * cold.depth_i);
        EXPECT_NEAR(swapped.cap_j, cold.cap_i, tolerance * cold.cap_i);
    }
    RecordProperty("worst_relative_error", fmt::format("{:.2e}", worst));
    EXPECT_LT(worst, tolerance);
}

INSTANTIATE_TEST_SUITE_P(Depths, ChordAgainstLongDouble,
                         testing::Values(Level{0.15, 0.2, 400, 1e-12}, Level{0.1, 0.3, 400, 1e-12},
                                         Level{1e-2, 0.3, 400, 1e-12}, Level{1e-3, 0.3, 400, 2e-12},
                                         Level{1e-4, 0.3, 400, 2e-11}, Level{1e-6, 0.3, 400, 2e-9},
                                         Level{1e-9, 0.3, 400, 2e-6}));

TEST(Chord, TwoUnitDiscsInClosedForm) {
    const Ellipse i = make_ellipse(Vec2::Zero(), Mat2::Identity(), 1.0);
    for (double overlap : {1e-9, 1e-6, 1e-3, 0.1, 1.0}) {
        const Ellipse j = make_ellipse(Vec2{2.0 - overlap, 0.0}, Mat2::Identity(), 1.0);
        WarmStart deepest;
        const Chord c = chord_of(i, j, deepest);
        const double depth = 1.0 - 0.5 * j.center.x();
        EXPECT_NEAR(c.depth_i, depth, 1e-15);
        EXPECT_NEAR(c.depth_j, depth, 1e-15);
        EXPECT_NEAR(c.length, 2.0 * std::sqrt(depth * (2.0 - depth)), 1e-14 / std::sqrt(overlap));
        EXPECT_NEAR(c.normal.x(), 1.0, 1e-12);
        EXPECT_NEAR(c.point.x(), 0.5 * j.center.x(), 1e-14);
    }
}

TEST(Chord, NoContactWhenApart) {
    std::mt19937_64 random(3);
    for (int k = 0; k < 200; ++k) {
        const RandomPair pair(random, 0.3, 0.3);
        WarmStart deepest;
        EXPECT_EQ(chord_of(pair.i, pair.j(-1e-10), deepest).overlap, Overlap::none);
        EXPECT_EQ(chord_of(pair.i, pair.j(-0.5), deepest).overlap, Overlap::none);
    }
}

TEST(Chord, ContainedAndCoincident) {
    const Ellipse big = make_ellipse(Vec2{1.0, 2.0}, Mat2::Identity(), 1.0);
    WarmStart deepest;
    const Ellipse small = make_ellipse(Vec2{1.2, 2.1}, Mat2::Identity(), 0.3);
    EXPECT_EQ(chord_of(big, small, deepest).overlap, Overlap::contained);
    EXPECT_EQ(chord_of(small, big, deepest).overlap, Overlap::contained);
    // The undeformed radii do not tell which one lies inside.
    const Ellipse shrunk = make_ellipse(Vec2{1.0, 2.3}, 0.2 * Mat2::Identity(), 1.1);
    deepest = WarmStart{};
    EXPECT_EQ(chord_of(shrunk, big, deepest).overlap, Overlap::contained);
    EXPECT_EQ(chord_of(big, big, deepest).overlap, Overlap::coincident);
    Mat2 flat;
    flat << 1.5, 0.0, 0.0, 0.5;
    EXPECT_EQ(chord_of(big, make_ellipse(big.center, flat, 1.0), deepest).overlap, Overlap::coincident);
}

TEST(Chord, FourIntersectionsGiveTheDeepestPocket) {
    Mat2 flat, tall;
    flat << 1.8, 0.0, 0.0, 0.4;
    tall << 0.4, 0.0, 0.0, 1.8;
    const Ellipse i = make_ellipse(Vec2::Zero(), flat, 1.0);
    const Ellipse j = make_ellipse(Vec2{0.3, 0.1}, tall, 1.0);
    ASSERT_EQ(long_chord(i, j).crossings, 4);
    WarmStart deepest;
    const Chord c = chord_of(i, j, deepest);
    ASSERT_EQ(c.overlap, Overlap::four_points);
    // Both ends of the chord lie on both outlines.
    for (double side : {-0.5, 0.5}) {
        const Vec2 end = c.point + side * c.length * perpendicular(c.normal);
        EXPECT_NEAR((i.inverse * (end - i.center)).norm(), 1.0, 1e-12);
        EXPECT_NEAR((j.inverse * (end - j.center)).norm(), 1.0, 1e-12);
    }
}

TEST(Chord, StrongStrainsEndInAResultAndAgreeWithBisection) {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int chords = 0;
    for (int k = 0; k < 400; ++k) {
        const Ellipse i = make_ellipse(Vec2::Zero(), test::random_F(random, 0.85), 1.0);
        const Ellipse j =
            make_ellipse(Vec2{2.0 * unit(random), 2.0 * unit(random)}, test::random_F(random, 0.85), 0.9);
        WarmStart deepest;
        const Chord c = chord_of(i, j, deepest);
        const LongChord expected = long_chord(i, j);
        if (expected.crossings == 2) {
            ++chords;
            ASSERT_EQ(c.overlap, Overlap::chord) << "pair " << k;
            // Ends on nearly parallel outlines are badly conditioned.
            EXPECT_LT(largest_error(c, expected), 1e-8) << "pair " << k;
        } else {
            EXPECT_NE(c.overlap, Overlap::chord) << "pair " << k;
        }
        EXPECT_TRUE(std::isfinite(c.length + c.depth_i + c.depth_j + c.cap_i + c.cap_j));
    }
    EXPECT_GT(chords, 100);
}

TEST(Chord, WarmStartFollowsAMovingContact) {
    std::mt19937_64 random(5);
    const RandomPair pair(random, 0.3, 0.5);
    WarmStart kept;
    for (int k = 0; k <= 400; ++k) {
        const Ellipse j = pair.j(1e-3 * std::sin(0.05 * k) * k / 100.0);
        WarmStart cold;
        const Chord a = chord_of(pair.i, j, kept), b = chord_of(pair.i, j, cold);
        ASSERT_EQ(a.overlap, b.overlap);
        EXPECT_NEAR(a.length, b.length, 1e-10 * b.length + 2e-14 / (b.length + 1e-6));
    }
}

TEST(Polygon, ConvergesToTheExactChordWithTheSquareOfTheNodes) {
    std::mt19937_64 random(2);
    for (int k = 0; k < 20; ++k) {
        const RandomPair pair(random, 0.25, 0.5);
        const Ellipse j = pair.j(0.05);
        WarmStart deepest;
        const Chord exact = chord_of(pair.i, j, deepest);
        for (int nodes : {360, 36000}) {
            const Chord polygon = polygon_chord(pair.i, j, nodes);
            ASSERT_EQ(polygon.overlap, Overlap::chord);
            // A side of the polygon lies (pi/n)^2/2 inside the outline: 4e-5 of R for 360, against depths of
            // 0.02 R.
            const double band = 8e-3 * 360.0 * 360.0 / nodes / nodes;
            EXPECT_NEAR(polygon.length, exact.length, band * exact.length);
            EXPECT_NEAR(polygon.depth_i, exact.depth_i, band * exact.depth_i);
            EXPECT_NEAR(polygon.depth_j, exact.depth_j, band * exact.depth_j);
            EXPECT_NEAR(polygon.cap_i, exact.cap_i, band * exact.cap_i);
            EXPECT_NEAR(polygon.cap_j, exact.cap_j, band * exact.cap_j);
            EXPECT_NEAR((polygon.normal - exact.normal).norm(), 0.0, band);
            EXPECT_NEAR((polygon.point - exact.point).norm(), 0.0, band);
        }
    }
}

TEST(Polygon, MissesWhatIsSmallerThanItsSides) {
    std::mt19937_64 random(4);
    int missed = 0;
    for (int k = 0; k < 30; ++k) {
        const RandomPair pair(random, 0.2, 0.5);
        missed += polygon_chord(pair.i, pair.j(1e-6)).overlap == Overlap::none ? 1 : 0;
    }
    EXPECT_GT(missed, 20);
}

}  // namespace
}  // namespace softgrain::sdem
