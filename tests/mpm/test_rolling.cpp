// Grains that roll and slide, and walls that hold them.
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "tests/mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

/// A disc on a floor, gravity tilted by an angle: it rolls, and slides if friction is below tan(angle) / 3.
/// Rigid discs roll with 2/3 g sin(angle) and slide with g (sin - mu cos).
TEST(Friction, ADiscRollsOrSlidesDownAPlane) {
    const double angle = 0.4, g = 1e-4;
    for (const double mu : {0.5, 0.05}) {
        Scenario scenario = test::scenario_with(0.3, 8);
        scenario.material.wall_friction = mu;
        scenario.box.gravity = {g * std::sin(angle), -g * std::cos(angle)};
        test::settings(scenario).set("driver", std::string("implicit"));
        Packing packing;
        packing.box.position = {-1.0, 20.0, 0.0, 5.0};
        packing.center = {{1.0, 0.5}};
        packing.radius = {0.5};
        const auto solver = method().make(scenario, packing);
        const WallMotion still{packing.box, {}};
        const double dt = 4.0;
        const int steps = 60;
        for (int k = 0; k < steps; ++k) solver->advance(still, dt);
        const GrainView view = solver->view(Need::all);
        const double expected = mu > std::tan(angle) / 3.0 ? 2.0 / 3.0 * g * std::sin(angle)
                                                           : g * (std::sin(angle) - mu * std::cos(angle));
        const double t = steps * dt;
        // Euler's implicit method: t (t + dt) / 2. Its weight flattens it by about 1e-4 R.
        EXPECT_NEAR(view.centroid[0].x() - 1.0, expected * t * (t + dt) / 2.0, 0.01 * expected * t * t / 2.0)
            << mu;
        ASSERT_EQ(view.contacts.size(), 1U);
        const double normal = view.contacts[0].normal_force(),
                     tangential = std::abs(view.contacts[0].force.x());
        EXPECT_NEAR(normal, view.mass[0] * g * std::cos(angle), 0.05 * normal);
        EXPECT_LE(tangential, mu * normal * (1.0 + 1e-3));
        // What friction takes: nothing while it rolls.
        const double fallen = view.mass[0] * g * std::sin(angle) * (view.centroid[0].x() - 1.0);
        if (mu > 0.1)
            EXPECT_LT(view.energy.friction, 0.01 * fallen);
        else
            // It spins up with 2 mu g cos(angle) meanwhile, over which the surfaces do not slip.
            EXPECT_NEAR(view.energy.friction,
                        mu / std::tan(angle) * fallen *
                            (1.0 - 2.0 * mu * std::cos(angle) / (std::sin(angle) - mu * std::cos(angle))),
                        0.02 * view.energy.friction);
    }
}

TEST(Friction, QuasiStaticRefusesItAndNamesTheCure) {
    Scenario scenario = test::scenario_with(0.3, 8);
    scenario.material.friction = 0.5;
    try {
        (void)method().make(scenario, test::one_grain(true));
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("mpm.driver = \"implicit\""), std::string::npos);
    }
}

/// Two walls press a grain with N each, weight pulls it along them: it stays if that is below 2 mu N, else it
/// slides with the difference.
TEST(Friction, AGrainBetweenWallsSlidesWhereItsWeightIsMoreThanTheyCanHold) {
    const double mu = 0.2;
    for (const double load : {0.5, 1.5}) {
        Scenario scenario = test::scenario_with(0.3, 8);
        scenario.material.wall_friction = mu;
        test::settings(scenario).set("driver", std::string("implicit"));
        Packing packing = test::one_grain(false);
        packing.box.position[1] = 30.0;
        // Pressed by 1 % of its diameter: N as without weight.
        MpmSolver pressed(scenario, packing);
        for (int k = 0; k < 4; ++k)
            pressed.advance({pressed.view(Need::base).box, {0.0, 0.0, 0.00125, -0.00125}}, 1.0);
        for (int k = 0; k < 20; ++k) pressed.advance({pressed.view(Need::base).box, {}}, 5.0);
        const double N = pressed.wall_force()[3].y(), mass = pressed.view(Need::base).mass[0];
        Checkpoint state;
        pressed.save(state);

        const double g = load * 2.0 * mu * N / mass;
        scenario.box.gravity = {g, 0.0};
        MpmSolver solver(scenario, packing);
        solver.load(state);
        const double begun = solver.view(Need::base).centroid[0].x(), dt = 1.0;
        const int steps = 40;
        for (int k = 0; k < steps; ++k) solver.advance({solver.view(Need::base).box, {}}, dt);
        const GrainView view = solver.view(Need::contacts);
        const double moved = view.centroid[0].x() - begun, t = steps * dt;
        double held = 0.0;
        for (const GrainContact& c : view.contacts) held -= c.force.x();
        if (load < 1.0) {
            EXPECT_LT(moved, 0.01);
            EXPECT_NEAR(held, mass * g, 0.02 * mass * g);
        } else {
            // N falls by what bends the grain, a few percent here.
            EXPECT_NEAR(held, 2.0 * mu * N, 0.05 * 2.0 * mu * N);
            EXPECT_NEAR(moved, (g - 2.0 * mu * N / mass) * t * (t + dt) / 2.0, 0.1 * moved);
            EXPECT_GT(view.energy.friction, 0.9 * 2.0 * mu * N * moved);
        }
    }
}

}  // namespace
}  // namespace softgrain::mpm
