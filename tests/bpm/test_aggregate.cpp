#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bpm/aggregate.hpp"
#include "bpm/disc_sizes.hpp"
#include "bpm/outline.hpp"

namespace softgrain::bpm {
namespace {

Aggregate grain(int discs, std::uint64_t seed, int index, double radius = 1.0) {
    return prepare_aggregate({discs, 1.625, 0.3, seed, index}, radius);
}

TEST(DiscSizes, VolumesAreUniform) {
    Random random(4, 2);
    const double k = 1.625;
    const int count = 20000;
    std::vector<double> radii = uniform_volume_radii(count, k, random);
    std::sort(radii.begin(), radii.end());
    const double low = radii.front(), high = radii.back();
    EXPECT_LE(high / low, k);
    EXPECT_GT(high / low, 0.999 * k);
    double mean = 0.0;
    for (double r : radii) mean += 2.0 * r / count;
    EXPECT_NEAR(mean, 1.0, 0.004);  // 4 standard errors: deviation 0.13 / sqrt(20000) = 0.0009
    // Kolmogorov-Smirnov distance of the areas from the uniform distribution; 1.63 / sqrt(n) at 1 %.
    double distance = 0.0;
    for (int n = 0; n < count; ++n) {
        const double r = radii[static_cast<std::size_t>(n)];
        const double u = (r * r - low * low) / (high * high - low * low);
        distance = std::max(distance, std::abs(u - (n + 0.5) / count));
    }
    EXPECT_LT(distance, 1.63 / std::sqrt(count));
}

TEST(DiscSizes, StreamsDiffer) {
    Random a(1, 0), b(1, 1), c(2, 0), again(1, 0);
    const double first = a.uniform();
    EXPECT_NE(first, b.uniform());
    EXPECT_NE(first, c.uniform());
    EXPECT_EQ(first, again.uniform());
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

TEST(Aggregate, OneDiscIsTheDisc) {
    const Aggregate a = grain(1, 1, 0, 2.0);
    ASSERT_EQ(a.x.size(), 1U);
    EXPECT_NEAR(a.radius[0], 2.0, 1e-12);
    EXPECT_LT(a.x[0].norm(), 1e-12);
}

}  // namespace
}  // namespace softgrain::bpm
