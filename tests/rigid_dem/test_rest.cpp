// Blocks at rest are left out of the steps.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "tests/rigid_dem/scenes.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr double gravity = 1e-5, tolerance = 1e-5;
constexpr int columns = 160, rows = 40;
/// After this many most of the bed is at rest.
constexpr int steps_to_settle = 3800;

Scenario scenario_with_tolerance(double rest_tolerance) {
    return scenario_with([&](Scenario& s, Settings& table) {
        s.material = {.youngs_modulus = 1.0, .poisson_ratio = 0.3, .density = 1.0, .friction = 0.3};
        s.material.wall_friction = 0.3;
        s.box.gravity = {0.0, -gravity};
        table.set("restitution", 0.3);
        table.set("nonviscous_damping", 0.7);
        table.set("rest_tolerance", rest_tolerance);
    });
}

/// Discs of radius 1 in rows, each over the gaps of the one below; 25 blocks.
Packing bed() {
    Packing p;
    const double height = std::sqrt(3.0);
    p.box.position = {0.0, 2.0 * columns + 1.0, 0.0, 2.0 + height * (rows + 4)};
    for (int r = 0; r < rows; ++r)
        for (int c = 0; c < columns; ++c) {
            p.center.emplace_back(1.0 + 2.0 * c + (r % 2), 1.0 + height * r);
            p.radius.push_back(1.0);
        }
    return p;
}

/// The bed, and a disc above its right end that comes down on it from the start.
Packing pushed_bed(double speed) {
    Packing p = bed();
    p.center.emplace_back(2.0 * columns - 20.0, 2.1 + std::sqrt(3.0) * rows);
    p.radius.push_back(1.0);
    p.driven.push_back({.velocity = {0.0, -speed}});
    return p;
}

void advance(RigidDem& dem, const Packing& p, int steps, const std::array<double, 4>& velocity = {}) {
    WallMotion walls{p.box, velocity};
    for (int k = 0; k < steps; ++k) {
        dem.advance(walls, 0.5);
        walls.box = walls.after(0.5);
    }
}

TEST(Rest, WhatIsFarFromTheLoadIsLeftOutWithinTheTolerance) {
    const Packing p = pushed_bed(1e-4);
    RigidDem all(scenario_with_tolerance(0.0), p), dem(scenario_with_tolerance(tolerance), p);
    for (RigidDem* one : {&all, &dem}) advance(*one, p, steps_to_settle);
    const long long settling = dem.rest().left_out();
    for (RigidDem* one : {&all, &dem}) advance(*one, p, 2000);
    EXPECT_EQ(all.rest().left_out(), 0);
    EXPECT_GT(dem.rest().left_out() - settling, 2000 * 12) << "of 25 blocks";
    const GrainView expected = all.view(Need::base), view = dem.view(Need::base);
    // A layer is out of place by the tolerance at most against the next, so the top by that of all.
    double farthest = 0.0;
    for (std::size_t g = 0; g < p.size(); ++g)
        farthest = std::max(farthest, (view.centroid[g] - expected.centroid[g]).norm());
    EXPECT_LE(farthest, rows * tolerance);
    EXPECT_GT(farthest, 0.0);
    // A contact is wrong by 0.5 E for each tolerance that its grains are out of place.
    for (std::size_t w = 0; w < 4; ++w)
        EXPECT_LE((view.wall_force[w] - expected.wall_force[w]).norm(), columns * 0.5 * tolerance) << w;
    EXPECT_NEAR(view.wall_force[2].norm(), expected.wall_force[2].norm(),
                1e-3 * expected.wall_force[2].norm());
}

/// So slow that its own block would rest: a hundredth of the tolerance in 64 steps.
TEST(Rest, DrivenGrainsMoveHoweverSlowly) {
    Packing p = bed();
    p.center.emplace_back(2.0 * columns - 20.0, 2.0 + std::sqrt(3.0) * rows);
    p.radius.push_back(1.0);
    p.driven.push_back({.velocity = {0.0, -3e-9}});
    RigidDem dem(scenario_with_tolerance(tolerance), p);
    advance(dem, p, 2 * steps_to_settle);
    const auto driven = p.size() - 1;
    ASSERT_GT(dem.rest().left_out(), 0);
    std::size_t awake = 0;
    for (std::size_t b = 0; b < 26; ++b) awake += dem.rest().resting(b) ? 0 : 1;
    EXPECT_GE(awake, 1U) << "that of the driven grain";
    EXPECT_NEAR(dem.view(Need::base).velocity[driven].y(), -3e-9, 1e-12);
}

/// From a wall on the left to the last block.
TEST(Rest, BlocksWakeWhenWhatTheyTouchMoves) {
    const Packing p = bed();
    RigidDem all(scenario_with_tolerance(0.0), p), dem(scenario_with_tolerance(tolerance), p);
    for (RigidDem* one : {&all, &dem}) advance(*one, p, 2 * steps_to_settle);
    const long long settled = dem.rest().left_out();
    for (RigidDem* one : {&all, &dem}) advance(*one, p, 100);
    EXPECT_EQ(dem.rest().left_out() - settled, 100 * 25) << "all 25 blocks rest";
    for (RigidDem* one : {&all, &dem}) advance(*one, p, 1600, {1e-3, 0.0, 0.0, 0.0});
    const std::size_t last = columns - 1;
    const double moved = all.view(Need::base).centroid[last].x() - p.center[last].x();
    EXPECT_GT(moved, 100.0 * tolerance) << "the push has arrived at the other side";
    EXPECT_NEAR(dem.view(Need::base).centroid[last].x() - p.center[last].x(), moved, 0.01 * moved);
}

TEST(Rest, TheLedgerStaysClosed) {
    const Packing p = pushed_bed(1e-4);
    RigidDem dem(scenario_with_tolerance(tolerance), p);
    advance(dem, p, steps_to_settle + 2000);
    ASSERT_GT(dem.rest().left_out(), 0);
    const EnergyLedger e = dem.view(Need::base).energy;
    EXPECT_NEAR(e.kinetic + e.elastic + e.dissipated(), e.external_work, 0.02 * e.external_work);
}

/// However large the tolerance.
TEST(Rest, WhatFallsIsNotAtRest) {
    Packing p = bed();
    for (Vec2& x : p.center) x.y() += 3.0;
    RigidDem all(scenario_with_tolerance(0.0), p), dem(scenario_with_tolerance(1.0), p);
    for (RigidDem* one : {&all, &dem}) advance(*one, p, 500);
    EXPECT_EQ(dem.rest().left_out(), 0);
    const GrainView expected = all.view(Need::base), view = dem.view(Need::base);
    for (std::size_t g = 0; g < p.size(); ++g)  // other blocks, so other sums
        EXPECT_LE((view.centroid[g] - expected.centroid[g]).norm(), 1e-9);
}

TEST(Rest, ARestartedRunHasTheSameBits) {
    const Packing p = pushed_bed(1e-4);
    testing::expect_restart_keeps_bits(
        [&] { return std::make_unique<RigidDem>(scenario_with_tolerance(tolerance), p); },
        [&](Solver& dem) {
            advance(static_cast<RigidDem&>(dem), p, steps_to_settle);
            return p.box;
        },
        [&](Solver& dem, const Box&) { advance(static_cast<RigidDem&>(dem), p, 500); },
        [](Solver& straight, Solver& restarted) {
            EXPECT_TRUE(static_cast<RigidDem&>(straight).rest().resting(0));
            EXPECT_EQ(straight.view(Need::base).energy.elastic, restarted.view(Need::base).energy.elastic);
        });
}

/// After steps in which blocks came to rest or woke.
TEST(Rest, ARestartWhereTheBlocksAtRestChangeHasTheSameBits) {
    const Packing p = pushed_bed(1e-4);
    RigidDem straight(scenario_with_tolerance(tolerance), p);
    advance(straight, p, steps_to_settle);
    int changes = 0;
    const auto resting = [&](std::size_t block) { return straight.rest().resting(block); };
    for (int k = 0; k < 2000 && changes < 6; ++k) {
        std::array<bool, 25> before{};
        for (std::size_t b = 0; b < before.size(); ++b) before[b] = resting(b);
        advance(straight, p, 1);
        bool changed = false;
        for (std::size_t b = 0; b < before.size(); ++b) changed = changed || before[b] != resting(b);
        if (!changed) continue;
        ++changes;
        RigidDem restarted(scenario_with_tolerance(tolerance), p);
        restarted.load(testing::saved(straight));
        advance(straight, p, 3);
        advance(restarted, p, 3);
        EXPECT_TRUE(testing::same_bits(testing::saved(straight), testing::saved(restarted)));
    }
    EXPECT_EQ(changes, 6);
}

TEST(Rest, ThreadsDoNotChangeIt) {
    const Packing p = pushed_bed(1e-4);
    RigidDem settled(scenario_with_tolerance(tolerance), p);
    advance(settled, p, steps_to_settle);
    const Checkpoint start = testing::saved(settled);
    testing::expect_threads_keep_bits(
        [&] {
            auto dem = std::make_unique<RigidDem>(scenario_with_tolerance(tolerance), p);
            dem->load(start);
            return dem;
        },
        {1, 2, 3},
        [&](RigidDem& dem) {
            advance(dem, p, 300);
            EXPECT_GT(dem.rest().left_out(), settled.rest().left_out());
        });
}

TEST(Rest, ClumpsAreRefused) {
    Packing p = bed();
    p.clumps = {ClumpShape{}};
    EXPECT_THROW(RigidDem(scenario_with_tolerance(tolerance), p), InputError);
}

}  // namespace
}  // namespace softgrain::rigid_dem
