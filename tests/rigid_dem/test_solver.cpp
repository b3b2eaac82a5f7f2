#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

#include "common/errors.hpp"
#include "tests/rigid_dem/scenes.hpp"

namespace softgrain::rigid_dem {
namespace {

Scenario elastic(double friction = 0.0, double restitution = 1.0) {
    return scenario_with([&](Scenario& s, Settings& table) {
        s.material.friction = friction;
        table.set("restitution", restitution);
        table.set("overlap_limit", 0.1);
    });
}

void run(RigidDem& dem, const Packing& p, double time, double dt) {
    const WallMotion rest{p.box, {}};
    for (int k = 0; k < static_cast<int>(time / dt); ++k) dem.advance(rest, dt);
}

/// Two equal discs on a spring k: contact lasts pi / omega, omega = sqrt(2 k / m); positions follow a half
/// sine.
TEST(RigidDem, CollisionFollowsTheHalfSine) {
    const Packing p = two_discs(0.0);
    RigidDem dem(elastic(), p);
    const double speed = 1e-3;
    dem.set_velocity(std::vector<Vec2>{{speed, 0.0}, {-speed, 0.0}}, std::vector<double>{0.0, 0.0});
    const double omega = std::sqrt(2.0 * 0.5 / std::numbers::pi);
    const double dt = 0.002 / omega;
    run(dem, p, 0.5 * std::numbers::pi / omega, dt);
    const GrainView view = dem.view(Need::base);
    const double overlap = 2.0 - (view.centroid[1] - view.centroid[0]).norm();
    EXPECT_NEAR(overlap, 2.0 * speed / omega, 2e-5 * speed);  // second order in dt
    run(dem, p, std::numbers::pi / omega, dt);
    EXPECT_NEAR(dem.view(Need::base).velocity[1].x(), speed, 1e-5 * speed);
}

TEST(RigidDem, RestitutionIsTheOneAskedFor) {
    for (const double e : {0.2, 0.5, 0.8, 1.0}) {
        const Packing p = two_discs(0.01);
        RigidDem dem(elastic(0.0, e), p);
        dem.set_velocity(std::vector<Vec2>{{0.01, 0.0}, {-0.01, 0.0}}, std::vector<double>{0.0, 0.0});
        run(dem, p, 30.0, 0.001);
        EXPECT_NEAR(dem.view(Need::base).velocity[1].x() / 0.01, e,
                    1e-3);  // first order in dt: the dashpot lags
    }
}

TEST(RigidDem, ObliqueCollisionKeepsLinearAndAngularMomentum) {
    Packing p = two_discs(0.05);
    p.center[1].y() = 0.6;
    RigidDem dem(elastic(0.5, 0.6), p);
    dem.set_velocity(std::vector<Vec2>{{0.02, 0.0}, {-0.01, 0.005}}, std::vector<double>{0.02, -0.01});
    const auto momenta = [&] {
        const GrainView v = dem.view(Need::base);
        Vec2 linear = Vec2::Zero();
        double angular = 0.0;
        for (std::size_t i = 0; i < 2; ++i) {
            linear += v.mass[i] * v.velocity[i];
            angular += v.mass[i] * cross(v.centroid[i], v.velocity[i]) + 0.5 * v.mass[i] * dem.spin()[i];
        }
        return std::pair(linear, angular);
    };
    const auto before = momenta();
    run(dem, p, 60.0, 0.005);
    const auto after = momenta();
    EXPECT_GT(dem.view(Need::base).energy.friction, 0.0) << "the discs should have slid";
    EXPECT_NEAR((after.first - before.first).norm(), 0.0, 1e-15);
    EXPECT_NEAR(after.second, before.second, 1e-13);
}

/// dt < 2 sqrt(m / k) of the course: the same collision explodes beyond the limit and not below it.
TEST(RigidDem, StabilityLimitIsWhereItIsPredicted) {
    Packing p;  // one disc squeezed between two walls: omega^2 = 2 E / m
    p.box.position = {0.0, 1.98, -5.0, 5.0};
    p.center = {{0.991, 0.0}};
    p.radius = {1.0};
    const double limit = 2.0 / std::sqrt(2.0 / std::numbers::pi);
    const auto speed_after = [&](double dt) {
        RigidDem dem(elastic(), p);
        const WallMotion rest{p.box, {}};
        for (int k = 0; k < 400; ++k) dem.advance(rest, dt);
        return dem.view(Need::base).velocity[0].norm();
    };
    const double starting =
        0.001 * std::sqrt(2.0 / std::numbers::pi);  // free oscillation from 0.001 off centre
    EXPECT_LT(speed_after(0.98 * limit), 2.0 * starting);
    EXPECT_GT(speed_after(1.02 * limit), 4.0 * starting);
    RigidDem dem(elastic(), p);
    EXPECT_LE(dem.stable_time_step(), 0.5 * limit * (1.0 + 1e-12));
}

/// Undamped contacts that open and close gain energy from longer steps.
TEST(RigidDem, TakesASmallerStepWhereNothingDamps) {
    const auto step = [](double nonviscous, std::optional<double> safety) {
        Scenario s;
        Settings table(method().keys());
        table.set("restitution", 1.0);
        table.set("nonviscous_damping", nonviscous);
        if (safety) table.set("safety", *safety);
        s.method_settings["rigid_dem"] = table;
        return RigidDem(s, two_discs(0.0)).stable_time_step();
    };
    EXPECT_NEAR(step(0.1, {}) / step(0.0, {}), 5.0, 1e-12);
    EXPECT_NEAR(step(0.0, 0.3) / step(0.0, {}), 3.0, 1e-12);
    EXPECT_NEAR(step(0.1, 0.3) / step(0.1, {}), 0.6, 1e-12);
}

/// Stiffness grows with the overlap: grains apart and at rest have none, but are about to.
TEST(RigidDem, HertzHasAFiniteStepBeforeTheFirstContact) {
    const Packing p = two_discs(0.5);
    const auto step = [&](const char* law) {
        return RigidDem(scenario_with([&](Scenario&, Settings& table) { table.set("normal_law", law); }), p)
            .stable_time_step();
    };
    EXPECT_GT(step("hertz"), step("linear"));
    EXPECT_LT(step("hertz"), 20.0 * step("linear"));  // k_n 1.5 sqrt(1e-3) of that at a unit overlap
}

/// A block without a pair in it has a time step too.
TEST(RigidDem, LoneGrainsOfTwoClassesAreFine) {
    Scenario s = elastic(0.3, 0.5);
    s.classes.resize(2);
    Packing p = two_discs(50.0);
    p.grain_class = {0, 1};
    RigidDem dem(s, p);
    run(dem, p, 100.0, 1.0);
    EXPECT_TRUE(std::isfinite(dem.stable_time_step()));
    EXPECT_EQ(dem.view(Need::base).velocity[0].norm(), 0.0);
}

TEST(RigidDem, LeavesItsValidityAtTheOverlapLimit) {
    Packing p = two_discs(-0.099);
    RigidDem inside(elastic(), p);
    EXPECT_FALSE(inside.outside_validity());
    p = two_discs(-0.101);
    RigidDem outside(elastic(), p);
    ASSERT_TRUE(outside.outside_validity());
    EXPECT_NE(outside.outside_validity()->find("grain 0 and grain 1"), std::string::npos);
}

TEST(RigidDem, WallsCountForTheOverlapLimit) {
    Packing p;
    p.box.position = {0.0, 5.0, 0.11, 5.0};
    p.center = {{2.0, 1.0}};
    p.radius = {1.0};
    RigidDem dem(elastic(), p);
    ASSERT_TRUE(dem.outside_validity());
    EXPECT_NE(dem.outside_validity()->find("grain 0 and the bottom wall is 0.110"), std::string::npos);
}

TEST(RigidDem, TooLargeAStepIsNamedAndNotHidden) {
    const Packing p = two_discs(-0.05);
    RigidDem dem(elastic(), p);
    try {
        run(dem, p, 1e6, 1e4);
        FAIL() << "should have diverged";
    } catch (const DivergedError& error) {
        EXPECT_EQ(error.grain, 0);
        EXPECT_EQ(error.quantity, "velocity");
    }
}

/// Lens of two discs: the closed form of the covered area.
TEST(RigidDem, CoveredAreaCountsOverlapsOnce) {
    const Packing p = two_discs(-0.1);
    RigidDem dem(elastic(), p);
    const double d = 1.9;
    const double lens = 2.0 * std::acos(d / 2.0) - 0.5 * d * std::sqrt(4.0 - d * d);
    const GrainView view = dem.view(Need::area);
    EXPECT_NEAR(view.covered_area, 2.0 * std::numbers::pi - lens, 1e-13);
    EXPECT_NEAR(view.area[0], std::numbers::pi - 0.5 * lens, 1e-13);
}

}  // namespace
}  // namespace softgrain::rigid_dem
