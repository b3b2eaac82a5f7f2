// Distributions of forces and force chains of hand-made contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "common/observables/forces.hpp"

namespace softgrain {
namespace {

/// Grains of radius 1 by their places, and contacts between those that touch with given forces.
struct Sample {
    std::vector<Vec2> place;
    std::vector<GrainContact> contacts;
    std::vector<double> area;

    void grain(double x, double y) {
        place.emplace_back(x, y);
        area.push_back(std::numbers::pi);
    }
    void press(int i, int j, double force) {
        const Vec2 &a = place[static_cast<std::size_t>(i)], &b = place[static_cast<std::size_t>(j)];
        const Vec2 normal = (b - a).normalized();
        contacts.push_back({i, j, 0.5 * (a + b), normal, -force * normal, 0.0});
    }
    void press_wall(int i, int wall, double force) {
        const Vec2 normal = -wall_normal(wall);
        contacts.push_back(
            {i, -1 - wall, place[static_cast<std::size_t>(i)] + normal, normal, -force * normal, 0.0});
    }
    GrainView view() const {
        GrainView v;
        v.centroid = place;
        v.contacts = contacts;
        v.reference_area = area;
        return v;
    }
};

/// A column of 4 under load beside a column of 4 with a tenth of it, and a cross link that bears little.
Sample two_columns() {
    Sample s;
    for (const double x : {0.0, 2.0})
        for (int k = 0; k < 4; ++k) s.grain(x, 2.0 * k);
    for (int column : {0, 1}) {
        const double force = column == 0 ? 10.0 : 1.0;
        s.press_wall(4 * column, 2, force);
        s.press_wall(4 * column + 3, 3, force);
        for (int k = 0; k < 3; ++k) s.press(4 * column + k, 4 * column + k + 1, force);
    }
    s.press(1, 5, 0.5);
    return s;
}

TEST(ForceChains, AreTheColumnsThatCarry) {
    const Sample s = two_columns();
    const ForceChains found = force_chains(s.view(), std::numbers::pi / 4.0);
    EXPECT_EQ(found.chains, 1);
    EXPECT_EQ(found.chain, (std::vector<int>{0, 0, 0, 0, -1, -1, -1, -1}));
    // Two contacts of 10 N with arms of 1 m on pi m^2.
    EXPECT_NEAR(found.stress[0](1, 1), 20.0 / std::numbers::pi, 1e-14);
    EXPECT_NEAR(found.stress[2](0, 0), 0.0, 1e-14);
    EXPECT_NEAR(found.stress[1](0, 0), 0.5 / std::numbers::pi, 1e-14);
}

TEST(ForceChains, EndWhereTheyTurnTooMuch) {
    // An arc of seven discs, each turned against the last by 40 degrees; the pair at its end by 100.
    Sample s;
    double angle = 0.0;
    Vec2 at = Vec2::Zero();
    for (int k = 0; k < 5; ++k) {
        s.grain(at.x(), at.y());
        at += 2.0 * Vec2(std::cos(angle), std::sin(angle));
        angle += 40.0 * std::numbers::pi / 180.0;
    }
    for (int k = 0; k < 4; ++k) s.press(k, k + 1, 5.0);
    for (int k = 0; k < 20; ++k)
        s.grain(100.0 + 3.0 * k, 0.0);  // free, so that all of the arc is above the mean
    const auto chain_within = [&](double degrees) {
        const ForceChains found = force_chains(s.view(), degrees * std::numbers::pi / 180.0);
        return found.chains == 0 ? 0
                                 : static_cast<int>(std::count(found.chain.begin(), found.chain.end(), 0));
    };
    // The principal stress of an inner grain lies in the middle of its two contacts: 20 degrees from both.
    EXPECT_EQ(chain_within(25.0), 5);
    EXPECT_EQ(chain_within(15.0), 0);
}

TEST(ForceDistribution, IsADensityWithMeanOne) {
    Sample s;
    s.grain(0.0, 0.0);
    s.grain(2.0, 0.0);
    for (const double force : {1.0, 1.0, 2.0, 4.0, -3.0, 0.0}) s.press(0, 1, force);  // mean of the four: 2
    s.press_wall(0, 0, 100.0);
    const Histogram h = force_distribution(s.view(), 0.25);
    ASSERT_EQ(h.value.size(), 9U);  // up to 2.25
    EXPECT_DOUBLE_EQ(h.value[2], 2.0);
    EXPECT_DOUBLE_EQ(h.value[4], 1.0);
    EXPECT_DOUBLE_EQ(h.value[8], 1.0);
    EXPECT_DOUBLE_EQ(0.25 * std::accumulate(h.value.begin(), h.value.end(), 0.0), 1.0);
    EXPECT_DOUBLE_EQ(h.middle(2), 0.625);
    EXPECT_TRUE(force_distribution(GrainView{}, 0.25).value.empty());
}

}  // namespace
}  // namespace softgrain
