// Pair correlation of random points and of a lattice.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/observables/pair_correlation.hpp"
#include "common/packing/random.hpp"

namespace softgrain {
namespace {

TEST(PairCorrelation, IsOneForPointsWithoutOrder) {
    for (const bool periodic : {false, true}) {
        const Box box{{0.0, 20.0, 0.0, 10.0}, periodic, periodic ? 3.0 : 0.0};
        Random random(1);
        std::vector<Vec2> points;
        for (int k = 0; k < 4000; ++k) {
            const double x = random.between(0.0, 20.0);
            points.emplace_back(x, random.between(0.0, 10.0));
        }
        const Histogram g = pair_correlation(points, box, 0.5, 4.0);
        ASSERT_EQ(g.value.size(), 8U);
        // Pairs in a ring: 4000 * 20 * ring area / 2, 31000 in the first: 0.6 %; three of them.
        for (std::size_t b = 0; b < g.value.size(); ++b) EXPECT_NEAR(g.value[b], 1.0, 0.02) << b << periodic;
    }
}

TEST(PairCorrelation, CountsTheNeighboursOfALattice) {
    // Square lattice in a cell: 4 at 1, 4 at sqrt(2), 4 at 2.
    const Box box{{0.0, 8.0, 0.0, 8.0}, true};
    std::vector<Vec2> points;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y) points.emplace_back(x, y);
    constexpr double bin = 0.2;
    const Histogram g = pair_correlation(points, box, bin, 2.3);
    ASSERT_EQ(g.value.size(), 11U);
    for (std::size_t b = 0; b < g.value.size(); ++b) {
        // n - 1 others stand for a density of one.
        const double ring = std::numbers::pi * bin * bin * (2.0 * static_cast<double>(b) + 1.0);
        const double neighbours = g.value[b] * ring * 63.0 / 64.0;
        EXPECT_NEAR(neighbours, b == 5 || b == 7 || b == 10 ? 4.0 : 0.0, 1e-9) << b;
    }
}

TEST(PairCorrelation, ReachesNoFurtherThanTheSampleAllows) {
    const std::vector<Vec2> two{{0.0, 0.0}, {4.0, 1.0}};
    EXPECT_EQ(pair_correlation(two, {}, 0.1, 50.0).value.size(), 5U);  // half of the lower side
    EXPECT_TRUE(pair_correlation(two, {}, 1.0, 0.5).value.empty());
    EXPECT_TRUE(pair_correlation(std::vector<Vec2>(1, Vec2::Zero()), {}, 0.1, 1.0).value.empty());
}

}  // namespace
}  // namespace softgrain
