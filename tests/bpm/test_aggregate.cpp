#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bpm/aggregate.hpp"
#include "bpm/outline.hpp"
#include "tests/support/stop_later.hpp"

namespace softgrain::bpm {
namespace {

Aggregate grain(int discs, std::uint64_t seed, int index, double radius = 1.0) {
    Aggregate a = prepare_aggregate({.discs = discs, .seed = seed, .grain = index});
    scale(a, radius);
    return a;
}

TEST(Aggregate, MeetsItsBounds) {
    const Aggregate a = grain(100, 1, 0);
    ASSERT_EQ(a.x.size(), 100U);
    EXPECT_LT(a.speed, aggregate_speed_bound);
    // The overlap once more, from the discs themselves.
    double diameter = 0.0, overlap = 0.0;
    for (double r : a.radius) diameter += 2.0 * r / 100.0;
    for (std::size_t i = 0; i < 100; ++i)
        for (std::size_t j = i + 1; j < 100; ++j)
            overlap = std::max(overlap, a.radius[i] + a.radius[j] - (a.x[i] - a.x[j]).norm());
    EXPECT_LT(overlap / diameter, aggregate_overlap_bound);
    const auto [low, high] = std::minmax_element(a.radius.begin(), a.radius.end());
    EXPECT_LE(*high / *low, 1.625 + 1e-12);
}

TEST(Aggregate, IsCompactAndRound) {
    // Frictionless polydisperse discs: random close packing is 0.84; inside the outline of a small grain,
    // with its surface pores excluded, 0.85 to 0.88 was measured for 100 discs.
    for (int index = 0; index < 3; ++index) {
        const Aggregate a = grain(100, 3, index);
        double area = 0.0, reach = 0.0;
        Vec2 center = Vec2::Zero();
        for (std::size_t d = 0; d < a.x.size(); ++d) {
            area += a.radius[d] * a.radius[d];
            center += a.radius[d] * a.radius[d] * a.x[d];
            reach = std::max(reach, a.x[d].norm() + a.radius[d]);
        }
        EXPECT_GT(area, 0.84);
        EXPECT_LT(area, 0.89);
        EXPECT_NEAR(a.internal_packing_fraction, area, 1e-12);
        EXPECT_LT((center / area).norm(), 1e-12);
        EXPECT_LT(reach, 1.25);
    }
}

TEST(Aggregate, SameSeedSameGrainAndEveryGrainItsOwn) {
    const Aggregate a = grain(40, 5, 2), again = grain(40, 5, 2);
    EXPECT_EQ(a.x, again.x);
    EXPECT_EQ(a.radius, again.radius);
    EXPECT_NE(a.radius, grain(40, 5, 3).radius);
    EXPECT_NE(a.radius, grain(40, 6, 2).radius);
}

TEST(Aggregate, OutlineEnclosesTheGivenArea) {
    for (double radius : {1.0, 0.012}) {
        const Aggregate a = grain(60, 1, 0, radius);
        double diameter = 0.0;
        for (double r : a.radius) diameter += 2.0 * r / 60.0;
        std::vector<Pair> pairs;
        for (int i = 0; i < 60; ++i)
            for (int j = i + 1; j < 60; ++j) pairs.push_back({i, j});
        const double area = Outline(a.x, a.radius, 0.3 * diameter, pairs).area();
        // 2 %: rho is 0.3 of the mean diameter of the distribution, here of the 60 discs.
        EXPECT_NEAR(area / (std::numbers::pi * radius * radius), 1.0, 0.02);
    }
}

TEST(Aggregate, EveryLawOfSizesAndAttractionMeetsTheBounds) {
    for (const AggregateSpec& spec :
         std::vector<AggregateSpec>{{.discs = 60, .sizes = {DiscSizeLaw::single, 1.0}},
                                    {.discs = 60, .sizes = {DiscSizeLaw::uniform, 20.0}},
                                    {.discs = 60, .sizes = {DiscSizeLaw::uniform_volume, 20.0}},
                                    {.discs = 60, .attraction_exponent = 1.0},
                                    {.discs = 60, .attraction_exponent = 30.0},
                                    {.discs = 60, .attraction_range = 0.05},
                                    {.discs = 60, .attraction_exponent = 2.5, .attraction_range = 3.0},
                                    {.discs = 2},
                                    {.discs = 3, .attraction_range = 0.05}}) {
        const Aggregate a = prepare_aggregate(spec);
        double diameter = 0.0, overlap = 0.0, area = 0.0;
        const auto discs = static_cast<double>(spec.discs);
        for (double r : a.radius) {
            diameter += 2.0 * r / discs;
            area += r * r;
        }
        for (std::size_t i = 0; i < a.x.size(); ++i)
            for (std::size_t j = i + 1; j < a.x.size(); ++j)
                overlap = std::max(overlap, a.radius[i] + a.radius[j] - (a.x[i] - a.x[j]).norm());
        // The bound is in the mean diameter of the law, which these 60 discs have only nearly (20 %).
        EXPECT_LT(overlap / diameter, 1.3 * aggregate_overlap_bound);
        EXPECT_LT(a.speed, aggregate_speed_bound);
        // Two discs fill nearly all that encloses them; a crystal of equal discs 0.9069.
        EXPECT_GT(area, 0.84);
        EXPECT_LT(area, 0.99);
    }
}

/// Whatever it is at: thrown discs, sweeps, later steps. All of it would take hours.
TEST(Aggregate, AStopIsHeededBetweenSweeps) {
    for (const double seconds : {0.0, 0.5, 3.0}) {
        const testing::StopLater stop(seconds);
        EXPECT_THROW(grain(100'000, 1, 0), StopAsked);
        EXPECT_LT(stop.latency(), 10.0) << "0.1 to 1 s on a crowded machine";
    }
}

TEST(Aggregate, OneDiscIsTheDisc) {
    const Aggregate a = grain(1, 1, 0, 2.0);
    ASSERT_EQ(a.x.size(), 1U);
    EXPECT_NEAR(a.radius[0], 2.0, 1e-12);
    EXPECT_LT(a.x[0].norm(), 1e-12);
}

}  // namespace
}  // namespace softgrain::bpm
