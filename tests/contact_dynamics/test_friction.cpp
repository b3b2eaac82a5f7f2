// Closed forms of one frictional contact. A heavy disc of its own group plays the floor.
#include <gtest/gtest.h>

#include <cmath>

#include "common/contact_dynamics/contact_dynamics.hpp"
#include "disc_cloud.hpp"

namespace softgrain {
namespace {

const WallMotion far_walls{{{-1e9, 1e9, -1e9, 1e9}}, {}};

/// A disc (radius 0.5, mass 1) on top of a floor of huge mass and radius.
DiscCloud disc_on_floor(Vec2 v, double rim_speed) {
    return {{{0.0, -1e4}, {0.0, 0.5}}, {{0, 0}, v}, {1e4, 0.5}, {1e16, 1.0}, {0.0, rim_speed}, {0, 1}};
}

ContactSettings rubbing(double friction) {
    return {.tolerance = 1e-13, .skin = 0.1, .max_iterations = 100000, .between = {.friction = friction}};
}

TEST(Friction, SlidingTakesMuTimesTheNormalImpulse) {
    DiscCloud cloud = disc_on_floor({2.0, -1.0}, 0.0);
    ContactDynamics contacts(rubbing(0.1));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.v[1].x(), 2.0 - 0.1, 1e-9);
    EXPECT_NEAR(cloud.v[1].y(), 0.0, 1e-9);
    // T = 0.1 against the motion at the lower rim turns the disc clockwise: I w = -T r, I = m r^2 / 2.
    EXPECT_NEAR(cloud.rim_speed[1], -0.2, 1e-9);
}

TEST(Friction, EnoughFrictionMakesItRoll) {
    // Rolling takes T = m v / 3: two thirds of the speed stay, and the rim moves with the floor.
    DiscCloud cloud = disc_on_floor({0.6, -1.0}, 0.0);
    ContactDynamics contacts(rubbing(0.5));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.v[1].x(), 0.4, 1e-9);
    EXPECT_NEAR(cloud.v[1].x() + cloud.rim_speed[1], 0.0, 1e-9);
}

TEST(Friction, RollingDiscGoesOn) {
    DiscCloud cloud = disc_on_floor({0.6, -1.0}, -0.6);
    ContactDynamics contacts(rubbing(0.5));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.v[1].x(), 0.6, 1e-9);
    EXPECT_NEAR(cloud.rim_speed[1], -0.6, 1e-9);
}

TEST(Friction, DiscsOfOneGroupDoNotRub) {
    DiscCloud cloud = disc_on_floor({0.6, -1.0}, 0.0);
    cloud.group = {0, 0};
    ContactDynamics contacts(rubbing(0.5));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.v[1].x(), 0.6, 1e-9);
    EXPECT_EQ(cloud.rim_speed[1], 0.0);
}

ContactSettings rolling(double friction, double resistance) {
    ContactSettings settings = rubbing(friction);
    settings.between.rolling = resistance;
    return settings;
}

TEST(Rolling, ResistanceSlowsARollingDiscByItsLargestTorque) {
    // A rolling disc with friction enough to keep rolling: the torque C = mu_r (r_i + r_j) N slows it down;
    // v' = v - (2/3) C / (m r) with r_i + r_j the sum of the radii.
    DiscCloud cloud = disc_on_floor({0.6, -1.0}, -0.6);
    const double reach = 1e4 + 0.5, resistance = 1e-5, normal = 1.0;
    ContactDynamics contacts(rolling(0.9, resistance));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    const double speed = 0.6 - 2.0 / 3.0 * resistance * reach * normal / 0.5;
    EXPECT_NEAR(cloud.v[1].x(), speed, 1e-9);
    EXPECT_NEAR(cloud.rim_speed[1], -speed, 1e-9);
}

TEST(Rolling, EnoughResistanceMakesFrictionStopADisc) {
    // Neither sliding nor rolling is left: the whole momentum goes into the floor.
    DiscCloud cloud = disc_on_floor({0.6, -1.0}, 0.0);
    ContactDynamics contacts(rolling(0.9, 1.0));
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.v[1].x(), 0.0, 1e-9);
    EXPECT_NEAR(cloud.rim_speed[1], 0.0, 1e-9);
}

TEST(Rolling, WithinAGroupSpinsAreSharedAndKept) {
    // Two equal discs pressed together without friction: rolling resistance brings them to the same spin and
    // keeps the sum of the angular momenta.
    DiscCloud cloud{{{0, 0}, {1, 0}}, {{1, 0}, {-1, 0}}, {0.5, 0.5}, {1, 1}, {0.8, -0.2}, {0, 0}};
    ContactSettings settings = rubbing(0.0);
    settings.within.rolling = 10.0;
    ContactDynamics contacts(settings);
    contacts.solve(cloud.discs(), far_walls, 0.01);
    EXPECT_NEAR(cloud.rim_speed[0], 0.3, 1e-9);
    EXPECT_NEAR(cloud.rim_speed[1], 0.3, 1e-9);
}

TEST(Rolling, LawHoldsInACloud) {
    DiscCloud cloud = disc_cloud(9, 8, 8, 8);
    for (std::size_t d = 0; d < cloud.size(); ++d) {
        cloud.group[d] = static_cast<int>(d);
        cloud.rim_speed[d] = 0.3 * std::sin(3.0 * static_cast<double>(d));
    }
    const double resistance = 0.2;
    ContactDynamics contacts(rolling(0.3, resistance));
    ASSERT_TRUE(contacts.solve(cloud.discs(), far_walls, 0.1).converged);
    const ContactRows& rows = contacts.rows();
    int locked = 0, turning = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows.i[k]);
        const auto j = static_cast<std::size_t>(rows.j[k]);
        const double spin = cloud.rim_speed[j] / cloud.radius[j] - cloud.rim_speed[i] / cloud.radius[i];
        const double limit = resistance * (cloud.radius[i] + cloud.radius[j]) * rows.normal[k];
        EXPECT_LE(std::abs(rows.rolling[k]), limit + 1e-12);
        if (rows.normal[k] < 1e-6) continue;
        if (std::abs(rows.rolling[k]) < limit - 1e-9) {
            EXPECT_NEAR(spin, 0.0, 1e-9);
            ++locked;
        } else {
            EXPECT_LT(spin * rows.rolling[k], 1e-12);  // against the relative spin
            ++turning;
        }
    }
    EXPECT_GT(locked, 5);
    EXPECT_GT(turning, 5);
}

TEST(Friction, CoulombLawHoldsInACloud) {
    DiscCloud cloud = disc_cloud(9, 8, 8, 8);
    for (std::size_t d = 0; d < cloud.size(); ++d) cloud.group[d] = static_cast<int>(d);
    const double friction = 0.3;
    ContactDynamics contacts(rubbing(friction));
    const double h = 0.1;
    ASSERT_TRUE(contacts.solve(cloud.discs(), far_walls, h).converged);
    const ContactRows& rows = contacts.rows();
    int sticking = 0, sliding = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows.i[k]);
        const auto j = static_cast<std::size_t>(rows.j[k]);
        const Vec2 n = rows.direction[k];
        const double opening = n.dot(cloud.v[j] - cloud.v[i]) + rows.gap_speed[k];
        const double slip =
            perpendicular(n).dot(cloud.v[j] - cloud.v[i]) - cloud.rim_speed[i] - cloud.rim_speed[j];
        EXPECT_GT(opening, -1e-10);
        EXPECT_LT(std::min(opening, rows.normal[k]), 1e-10);
        EXPECT_LE(std::abs(rows.tangential[k]), friction * rows.normal[k] + 1e-12);
        if (rows.normal[k] < 1e-6) continue;
        if (std::abs(rows.tangential[k]) < friction * rows.normal[k] - 1e-9) {
            EXPECT_NEAR(slip, 0.0, 1e-9);
            ++sticking;
        } else {
            EXPECT_LT(slip * rows.tangential[k], 1e-12);  // friction acts against the slip
            ++sliding;
        }
    }
    EXPECT_GT(sticking, 5);
    EXPECT_GT(sliding, 5);
}

}  // namespace
}  // namespace softgrain
