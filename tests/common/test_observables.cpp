#include <gtest/gtest.h>

#include <cmath>

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

TEST(Stress, UnbalancedForceIsNetOverContactForce) {
    const std::vector<Vec2> x{{0.0, 0.0}, {2.0, 0.0}};
    const std::vector<GrainContact> contacts{{0, 1, {1.0, 0.0}, {1.0, 0.0}, {-4.0, 0.0}, 0.0}};
    GrainView view;
    view.centroid = x;
    view.contacts = contacts;
    EXPECT_DOUBLE_EQ(unbalanced_force(view), 1.0);
}

}  // namespace
}  // namespace softgrain
