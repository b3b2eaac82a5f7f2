// Grains that move as they are told.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/observables/coordination.hpp"
#include "common/observables/fabric.hpp"
#include "common/observables/stress.hpp"
#include "rigid_dem/method.hpp"
#include "rigid_dem/solver.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::rigid_dem {
namespace {

Scenario scenario_with(double gravity, double friction = 0.0, double nonviscous_damping = 0.0) {
    Scenario s;
    s.material = {.youngs_modulus = 1.0, .poisson_ratio = 0.3, .density = 1.0, .friction = friction};
    s.box.gravity = {0.0, -gravity};
    Settings table(method().keys());
    table.set("nonviscous_damping", nonviscous_damping);
    s.method_settings["rigid_dem"] = table;
    return s;
}

void add_driven(Packing& p, const Vec2& center, double radius, const DrivenMotion& motion) {
    p.center.push_back(center);
    p.radius.push_back(radius);
    p.driven.push_back(motion);
}

/// A disc above two that stand 2 apart and overlap a third.
Packing saddle() {
    Packing p;
    p.box.position = {0.0, 10.0, 0.0, 8.0};
    p.center = {{5.0, 2.0 + std::sqrt(3.0)}};
    p.radius = {1.0};
    for (const double x : {4.0, 6.0, 6.5}) add_driven(p, {x, 2.0}, 1.0, {});
    return p;
}

/// Twelve discs in a drum of a hundred that turns.
Packing drum(double spin) {
    Packing p;
    p.box.position = {-10.0, 10.0, -10.0, 10.0};
    for (int k = 0; k < 12; ++k) {
        p.center.emplace_back(-2.25 + 1.5 * (k % 4), -3.0 + 1.5 * (k / 4));
        p.radius.push_back(k % 2 == 0 ? 0.7 : 0.6);
    }
    for (int k = 0; k < 100; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 100.0;
        add_driven(p, 6.0 * Vec2{std::cos(angle), std::sin(angle)}, 0.25,
                   {.pivot = {0.0, 0.0}, .spin = spin});
    }
    return p;
}

void advance(RigidDem& dem, const Packing& p, int steps, double dt) {
    for (int k = 0; k < steps; ++k) dem.advance({p.box, {}}, dt);
}

TEST(Driven, DiscsCarryOthersAndDoNotGiveWay) {
    const Packing p = saddle();
    constexpr double gravity = 1e-3;
    RigidDem dem(scenario_with(gravity), p);
    advance(dem, p, 6000, dem.stable_time_step());
    const GrainView view = dem.view(Need::contacts | Need::area);
    for (std::size_t d = 1; d < 4; ++d) {
        EXPECT_EQ(view.centroid[d], p.center[d]);
        EXPECT_EQ(view.velocity[d], Vec2(0.0, 0.0));
    }
    ASSERT_EQ(view.contacts.size(), 2U) << "driven discs that overlap do not press on each other";
    // At 30 degrees from upright but for the overlap of 0.004.
    for (const GrainContact& c : view.contacts) {
        EXPECT_NEAR(c.normal.y(), -std::cos(std::numbers::pi / 6.0), 2e-3);
        EXPECT_NEAR(c.normal_force(), -0.5 * std::numbers::pi * gravity / c.normal.y(), 1e-8);
    }
    EXPECT_LE(unbalanced_force(view), 1e-5);
    const Coordination z = coordination(view);
    EXPECT_EQ(z.all, 0.0);
    EXPECT_EQ(z.with_walls, 2.0);
    EXPECT_EQ(z.rattlers, 0);
    EXPECT_EQ(fabric(view).anisotropy, 0.0);
    EXPECT_LT(view.covered_area, std::numbers::pi);
    EXPECT_GT(view.covered_area, 0.99 * std::numbers::pi);
    // Of the disc alone: its arms end at the contacts, half an overlap short of 1.
    const double force = view.contacts[0].normal_force();
    EXPECT_NEAR(love_weber_stress(view)(1, 1), 2.0 * force * 0.75 / p.box.area(),
                8e-3 * force / p.box.area());
}

TEST(Driven, DiscsAreWhereTheyWereToldToBe) {
    constexpr double spin = 0.03, dt = 0.05;
    const Packing p = drum(spin);
    RigidDem dem(scenario_with(1e-3, 0.5), p);
    constexpr int steps = 2000;
    advance(dem, p, steps, dt);
    EXPECT_GT(dem.listings(), 0) << "the list was made again";
    const GrainView view = dem.view(Need::base);
    ASSERT_EQ(view.driven, 100U);
    for (std::size_t d = 12; d < p.size(); ++d) {
        const double angle = std::atan2(p.center[d].y(), p.center[d].x()) + spin * steps * dt;
        const Vec2 there = 6.0 * Vec2{std::cos(angle), std::sin(angle)};
        EXPECT_LE((view.centroid[d] - there).norm(), 1e-9);
        // Half a step back, by the chord: a 24th of the square of a step's angle short.
        EXPECT_LE((view.velocity[d] - spin * perpendicular(there)).norm(), spin * 6.0 * spin * dt);
    }
    for (std::size_t g = 0; g < 12; ++g) EXPECT_LT(view.centroid[g].norm(), 6.0) << "the drum holds them";
}

/// By a quarter of the step: of the whole one 2 % are missing, for grains that tumble and slide lose springs
/// at each contact.
TEST(Driven, TheirWorkClosesTheLedger) {
    for (const double damping : {0.0, 0.2}) {
        const Packing p = drum(0.03);
        RigidDem dem(scenario_with(1e-3, 0.5, damping), p);
        advance(dem, p, 1600, 0.25 * dem.stable_time_step());
        const EnergyLedger fallen = dem.view(Need::base).energy;
        advance(dem, p, 16000, 0.25 * dem.stable_time_step());
        const EnergyLedger e = dem.view(Need::base).energy;
        EXPECT_GT(e.external_work, 2.0 * fallen.external_work) << "the drum lifts them and rubs";
        const double residual = e.external_work - e.kinetic - e.elastic - e.dissipated();
        EXPECT_LE(std::abs(residual), 5e-3 * e.external_work) << "with damping " << damping;
    }
}

/// Driven discs on and behind a wall are not what makes a run end.
TEST(Driven, DiscsMayStandInWalls) {
    Packing p = saddle();
    p.box.position[2] = 2.0;
    p.center[0].y() -= 0.15;
    RigidDem dem(scenario_with(1e-3), p);
    const auto why = dem.outside_validity();
    ASSERT_TRUE(why.has_value());
    EXPECT_NE(why->find("grain 0 and grain 1"), std::string::npos) << *why;
}

TEST(Driven, ARestartedRunHasTheSameBits) {
    const Packing p = drum(0.03);
    const auto run = [&](Solver& dem) {
        for (int k = 0; k < 700; ++k) dem.advance({p.box, {}}, 0.1);
        return p.box;
    };
    testing::expect_restart_keeps_bits(
        [&] { return std::make_unique<RigidDem>(scenario_with(1e-3, 0.5), p); }, run,
        [&](Solver& dem, const Box&) { run(dem); });
}

}  // namespace
}  // namespace softgrain::rigid_dem
