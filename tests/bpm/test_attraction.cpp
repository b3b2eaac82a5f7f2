#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "bpm/attraction.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

/// The paper's Eq. 1 with pow, for any exponent: attraction of i towards j.
Vec2 reference_attraction(const Vec2& xi, const Vec2& xj, double a0, double maximum_force, double exponent) {
    const Vec2 line = xj - xi;
    const double distance = line.norm();
    const double gap = distance - a0;
    if (gap > a0) return Vec2::Zero();
    if (gap < 0.0) return maximum_force / a0 * line;  // capped: the discs overlap
    return maximum_force * std::pow(1.0 + gap / a0, -exponent) * line / distance;
}

struct Discs {
    std::vector<Vec2> x;
    std::vector<double> radius;
};

Discs random_discs(unsigned seed, int count) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Discs discs;
    const double side = 0.6 * std::sqrt(static_cast<double>(count));
    for (int k = 0; k < count; ++k) {
        discs.x.emplace_back(side * unit(random), side * unit(random));
        discs.radius.push_back(0.4 + 0.2 * unit(random));
    }
    return discs;
}

std::vector<Vec2> reference_forces(const Discs& discs, const std::vector<int>& start, double f0) {
    std::vector<Vec2> force(discs.x.size(), Vec2::Zero());
    for (std::size_t g = 0; g + 1 < start.size(); ++g)
        for (auto i = static_cast<std::size_t>(start[g]); i < static_cast<std::size_t>(start[g + 1]); ++i)
            for (auto j = static_cast<std::size_t>(start[g]); j < static_cast<std::size_t>(start[g + 1]); ++j)
                if (i != j)
                    force[i] += reference_attraction(discs.x[i], discs.x[j],
                                                     discs.radius[i] + discs.radius[j], f0, 7.0);
    return force;
}

TEST(Attraction, EqualsThePrintedLawWithPow) {
    const Discs discs = random_discs(1, 90);
    const std::vector<int> start{0, 40, 90};
    Attraction attraction({2.5}, start, discs.radius, 0.3);
    std::vector<Vec2> force(discs.x.size());
    attraction.forces(discs.x, 0.0, force);
    const std::vector<Vec2> expected = reference_forces(discs, start, 2.5);
    for (std::size_t d = 0; d < force.size(); ++d) EXPECT_LT((force[d] - expected[d]).norm(), 1e-12) << d;
}

TEST(Attraction, IsTheDerivativeOfThePotential) {
    const AttractionLaw law{1.7};
    const double a0 = 0.9;
    for (double distance : {0.7, 0.85, 0.95, 1.1, 1.4, 1.75}) {
        const double e = 1e-6;
        const double slope = (law.potential(distance + e, a0) - law.potential(distance - e, a0)) / (2.0 * e);
        const double force = reference_attraction({0, 0}, {distance, 0}, a0, 1.7, 7.0).x();
        EXPECT_NEAR(slope, force, 1e-8) << distance;
    }
    EXPECT_EQ(law.potential(1.81, a0), 0.0);
    EXPECT_NEAR(law.potential(1.7999999, a0), 0.0, 1e-7);
    EXPECT_NEAR(law.potential(a0, a0), -1.7 * a0 * 63.0 / 384.0, 1e-14);
}

TEST(Attraction, EnergySumsThePairsOfEachGrain) {
    const Discs discs = random_discs(2, 60);
    const AttractionLaw law{1.0};
    Attraction attraction(law, {0, 25, 60}, discs.radius, 0.3);
    std::vector<Vec2> force(discs.x.size());
    attraction.forces(discs.x, 0.0, force);
    double expected = 0.0;
    for (std::size_t i = 0; i < 60; ++i)
        for (std::size_t j = i + 1; j < 60; ++j)
            if ((i < 25) == (j < 25))
                expected +=
                    law.potential((discs.x[i] - discs.x[j]).norm(), discs.radius[i] + discs.radius[j]);
    EXPECT_NEAR(attraction.energy(discs.x), expected, 1e-12 * std::abs(expected));
}

TEST(Attraction, ListsFollowMovingDiscs) {
    // Steps below the skin, a drift of the whole, and a slow shear: always the same as a fresh all-pairs sum.
    Discs discs = random_discs(3, 50);
    Attraction attraction({1.0}, {0, 50}, discs.radius, 0.2);
    std::vector<Vec2> force(50);
    for (int step = 0; step < 40; ++step) {
        attraction.forces(discs.x, 0.0, force);
        const std::vector<Vec2> expected = reference_forces(discs, {0, 50}, 1.0);
        for (std::size_t d = 0; d < 50; ++d) ASSERT_LT((force[d] - expected[d]).norm(), 1e-12) << step;
        for (Vec2& x : discs.x) x += Vec2(0.5 + 0.02 * x.y(), 0.3);
    }
}

TEST(Attraction, NamesTheGrainThatLostADisc) {
    Discs discs{{{0, 0}, {1, 0}, {10, 0}, {11, 0}, {30, 0}}, {0.5, 0.5, 0.5, 0.5, 0.5}};
    Attraction attraction({1.0}, {0, 2, 5}, discs.radius, 0.3);
    std::vector<Vec2> force(5);
    try {
        attraction.forces(discs.x, 1.5, force);
        FAIL() << "no error";
    } catch (const DivergedError& error) {
        EXPECT_EQ(error.grain, 1);
        EXPECT_EQ(error.time, 1.5);
    }
}

}  // namespace
}  // namespace softgrain::bpm
