#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "common/observables/coordination.hpp"
#include "common/observables/stress.hpp"

namespace softgrain {
namespace {

GrainContact between(int i, int j) {
    return {i, j, Vec2::Zero(), Vec2{1.0, 0.0}, Vec2::Zero(), 0.0};
}

/// A triangle that carries load, with a chain of two grains hanging on it: both are rattlers, one after the
/// other.
TEST(Coordination, RattlersAreRemovedRepeatedly) {
    const std::vector<Vec2> x(6, Vec2::Zero());
    const std::vector<GrainContact> contacts{between(0, 1), between(0, 2), between(1, 2), between(2, 3),
                                             between(3, 4)};
    GrainView view;
    view.centroid = x;
    view.contacts = contacts;
    const Coordination z = coordination(view);
    EXPECT_DOUBLE_EQ(z.all, 2.0 * 5.0 / 6.0);
    EXPECT_EQ(z.rattlers, 3);
    EXPECT_DOUBLE_EQ(z.without_rattlers, 2.0);
    EXPECT_DOUBLE_EQ(z.with_walls, z.all);
}

TEST(Coordination, WallContactsHoldAGrain) {
    const std::vector<Vec2> x(2, Vec2::Zero());
    const std::vector<GrainContact> contacts{between(0, -1), between(0, 1), between(1, -2)};
    GrainView view;
    view.centroid = x;
    view.contacts = contacts;
    const Coordination z = coordination(view);
    EXPECT_EQ(z.rattlers, 0);
    EXPECT_DOUBLE_EQ(z.all, 1.0);
    EXPECT_DOUBLE_EQ(z.with_walls, 2.0);
}

/// Random contacts, against removal one grain at a time until nothing changes.
TEST(Coordination, RattlersOfRandomContacts) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const int n = 30;
        std::uniform_int_distribution<int> any(0, n - 1);
        std::vector<GrainContact> contacts;
        for (int k = 0; k < 25 + trial % 10; ++k) {
            const int a = any(random), b = any(random);
            if (a != b) contacts.push_back(between(std::min(a, b), k % 7 == 0 ? -1 : std::max(a, b)));
        }
        // Some touch in two places, which count once.
        const auto key = [](const GrainContact& c) { return std::pair(c.i, c.j); };
        for (std::size_t k = 0; k < 5; ++k) contacts.push_back(contacts[k]);
        std::ranges::sort(contacts, {}, key);
        const std::vector<GrainContact> places = contacts;
        contacts.erase(std::ranges::unique(contacts, {}, key).begin(), contacts.end());
        ASSERT_GE(places.size(), contacts.size() + 5);
        std::vector<bool> gone(n, false);
        const auto present = [&](const GrainContact& c) {
            return !gone[static_cast<std::size_t>(c.i)] && (c.j < 0 || !gone[static_cast<std::size_t>(c.j)]);
        };
        for (bool changed = true; changed;) {
            changed = false;
            for (int g = 0; g < n && !changed; ++g) {
                const auto held = std::count_if(contacts.begin(), contacts.end(), [&](const GrainContact& c) {
                    return present(c) && (c.i == g || c.j == g);
                });
                if (gone[static_cast<std::size_t>(g)] || held >= 2) continue;
                gone[static_cast<std::size_t>(g)] = changed = true;
            }
        }
        const auto rattlers = static_cast<int>(std::count(gone.begin(), gone.end(), true));
        const auto carrying = std::count_if(contacts.begin(), contacts.end(),
                                            [&](const GrainContact& c) { return c.j >= 0 && present(c); });
        const std::vector<Vec2> x(n, Vec2::Zero());
        GrainView view;
        view.centroid = x;
        view.contacts = places;
        const Coordination z = coordination(view);
        EXPECT_EQ(z.rattlers, rattlers);
        if (rattlers < n) {
            EXPECT_DOUBLE_EQ(z.without_rattlers, 2.0 * static_cast<double>(carrying) / (n - rattlers));
        }
    }
}

/// One disc of radius 1 between four walls, 3 N on each vertical wall and 5 N on each horizontal one.
TEST(Stress, WallsAndLoveWeberAgreeForOneGrain) {
    Box box;
    box.position = {-1.0, 1.0, -1.0, 1.0};
    const std::vector<Vec2> x{{0.0, 0.0}};
    std::vector<GrainContact> contacts;
    std::array<Vec2, 4> on_wall;
    for (int w = 0; w < 4; ++w) {
        const Vec2 n = wall_normal(w);
        const double force = w < 2 ? 3.0 : 5.0;
        contacts.push_back({0, -1 - w, -n, -n, force * n, 0.0});
        on_wall[static_cast<std::size_t>(w)] = -force * n;
    }
    GrainView view;
    view.box = box;
    view.centroid = x;
    view.contacts = contacts;
    const Vec2 from_walls = wall_stress(on_wall, box);
    EXPECT_DOUBLE_EQ(from_walls.x(), 1.5);
    EXPECT_DOUBLE_EQ(from_walls.y(), 2.5);
    const Mat2 from_contacts = love_weber_stress(view);
    EXPECT_DOUBLE_EQ(from_contacts(0, 0), 1.5);
    EXPECT_DOUBLE_EQ(from_contacts(1, 1), 2.5);
    EXPECT_DOUBLE_EQ(from_contacts(0, 1), 0.0);
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 0.0);
}

/// Two discs that touch side by side, then across the top edge of a tilted cell.
TEST(Stress, LoveWeberTakesTheNearestImage) {
    const Box cell{{0.0, 4.0, 0.0, 2.0}, true, 8.3};  // two flips and 0.3
    const std::vector<Vec2> x{{0.5, 1.0}, {2.0, 1.0}};
    std::vector<GrainContact> contacts{{0, 1, {1.5, 1.0}, {1.0, 0.0}, {-3.0, 0.5}, 0.0}};
    GrainView view;
    view.box = cell;
    view.centroid = x;
    view.contacts = contacts;
    EXPECT_NEAR((branch(view, contacts[0]) - Vec2(1.5, 0.0)).norm(), 0.0, 1e-14);
    EXPECT_NEAR(love_weber_stress(view)(0, 0), 3.0 * 1.5 / 8.0, 1e-14);
    EXPECT_NEAR(love_weber_stress(view)(1, 0), -0.5 * 1.5 / 8.0, 1e-14);
    // Across the top: j's image (tilt reduced 0.3, 2) above.
    const std::vector<Vec2> tall{{0.5, 1.9}, {0.9, 0.1}};
    contacts[0] = {0, 1, {0.6, 2.0}, {0.0, 1.0}, {0.0, -2.0}, 0.0};
    view.centroid = tall;
    EXPECT_NEAR((branch(view, contacts[0]) - Vec2(0.7, 0.2)).norm(), 0.0, 1e-13);
}

TEST(Stress, OfTheBoundaryIsSymmetric) {
    const std::array<Vec2, 4> on_wall{Vec2{-4.0, 1.0}, Vec2{4.0, 3.0}, Vec2{0.0, -2.0}, Vec2{6.0, 2.0}};
    const Box box{{0.0, 3.0, 0.0, 2.0}};
    const Mat2 walls = boundary_stress(on_wall, Mat2::Constant(9.0), box);
    EXPECT_DOUBLE_EQ(walls(0, 0), 2.0);
    EXPECT_DOUBLE_EQ(walls(1, 1), 2.0 / 3.0);
    EXPECT_DOUBLE_EQ(walls(0, 1), 0.5 * (0.5 * 2.0 / 2.0 + 0.5 * 6.0 / 3.0));
    EXPECT_EQ(walls(1, 0), walls(0, 1));
    Box cell = box;
    cell.periodic = true;
    const Mat2 given = (Mat2() << 1.0, 2.0, 4.0, 5.0).finished();
    EXPECT_EQ(boundary_stress(on_wall, given, cell), (Mat2() << 1.0, 3.0, 3.0, 5.0).finished());
}

TEST(Stress, UnbalancedForceIsNetOverContactForce) {
    const std::vector<Vec2> x{{0.0, 0.0}, {2.0, 0.0}};
    const std::vector<GrainContact> contacts{{0, 1, {1.0, 0.0}, {1.0, 0.0}, {-4.0, 0.0}, 0.0}};
    GrainView view;
    view.centroid = x;
    view.contacts = contacts;
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 1.0);
}

/// A disc of weight 4 on the floor carries one of weight 6 that has just half its contact force.
TEST(Stress, UnbalancedForceCountsTheWeights) {
    const std::vector<Vec2> x{{0.0, 1.0}, {0.0, 3.0}};
    const std::vector<double> mass{2.0, 3.0};
    std::vector<GrainContact> contacts{{0, -3, {0.0, 0.0}, {0.0, -1.0}, {0.0, 10.0}, 0.0},
                                       {0, 1, {0.0, 2.0}, {0.0, 1.0}, {0.0, -6.0}, 0.0}};
    GrainView view;
    view.centroid = x;
    view.mass = mass;
    view.gravity = {0.0, -2.0};
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 1.0) << "free fall";
    view.contacts = contacts;
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 0.0);
    contacts[1].force.y() = -3.0;
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 0.5 * (3.0 + 3.0) / 6.5);
}

}  // namespace
}  // namespace softgrain
