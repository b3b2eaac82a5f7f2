// Ellipses, hard and soft grains, extra inertia against changes of area.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"
#include "sdem/geometry/chord.hpp"
#include "sdem/laws/lens_potential.hpp"

namespace softgrain::sdem {
namespace {

Packing one_ellipse(double aspect_ratio, double angle, const Box& box = test::far_away()) {
    Packing p = test::packing_of(box, {Vec2::Zero()}, {1.0});
    p.aspect_ratio = {aspect_ratio};
    p.angle = {angle};
    return p;
}
TEST(EllipticGrain, StartsWithTheAreaAxesAndAngleOfThePacking) {
    const Packing packing = test::mixture_packing();
    Scenario s = test::undamped_scenario();
    test::add_classes(s, 1.0, 0.3);
    auto solver = test::solver_for(s, packing);
    const GrainView v = solver->view(Need::all);
    for (std::size_t g = 0; g < packing.size(); ++g) {
        EXPECT_NEAR(v.reference_area[g], std::numbers::pi * packing.radius[g] * packing.radius[g], 1e-12);
        const Mat2 F = test::state_of(*solver).F[g];
        const Mat2 axes = F * packing.half_axes(g).asDiagonal();
        EXPECT_NEAR((axes * axes.transpose() - packing.shape_of(g) * packing.shape_of(g).transpose()).norm(),
                    0.0, 1e-12);
    }
    // Extent along a direction n is |shape n|: an ellipse stands exactly that far from its centre.
    auto alone = test::solver_for(test::undamped_scenario(), one_ellipse(2.0, 0.6));
    const GrainView w = alone->view(Need::outlines);
    const Mat2 shape = one_ellipse(2.0, 0.6).shape_of(0);
    double extent = 0.0;
    for (const Vec2& point : w.outline_point) extent = std::max(extent, point.y());
    EXPECT_NEAR(extent, (shape * Vec2{0.0, 1.0}).norm(), 5e-3);  // 64 nodes
}

TEST(EllipticGrain, ContactsAreTheChordsOfTheirEllipses) {
    const Packing packing = test::mixture_packing();
    Scenario s = test::undamped_scenario();
    test::add_classes(s, 1.0, 0.3);
    auto solver = test::solver_for(s, packing);
    const auto ellipse = [&](int g) {
        const auto k = static_cast<std::size_t>(g);
        return make_ellipse(packing.center[k], packing.shape_of(k), 1.0);
    };
    int pairs = 0;
    for (const GrainContact& c : solver->view(Need::contacts).contacts) {
        if (c.with_wall()) continue;
        WarmStart cold;
        const Chord chord = chord_of(ellipse(c.i), ellipse(c.j), cold);
        ASSERT_TRUE(chord.touching());
        EXPECT_NEAR(c.length, chord.length, 1e-11);
        EXPECT_NEAR((c.point - chord.point).norm(), 0.0, 1e-11);
        EXPECT_NEAR((c.normal - chord.normal).norm(), 0.0, 1e-10);
        ++pairs;
    }
    EXPECT_GE(pairs, 6);
}

TEST(EllipticGrain, SpinsWithItsOwnInertia) {
    // A wall presses the rigid ellipse off its centre: I spin' = r x f with I = m (a^2 + b^2)/4.
    Scenario s = test::undamped_scenario();
    test::settings(s).set("kinematics", std::string("D2F0"));
    const double angle = 0.5, aspect = 2.5;
    const Mat2 shape = one_ellipse(aspect, angle).shape_of(0);
    const double extent = (shape * Vec2{0.0, 1.0}).norm();
    const Packing packing = one_ellipse(aspect, angle, Box{{-50.0, 50.0, -extent + 0.05, 50.0}});
    auto solver = test::solver_for(s, packing);
    const test::Bodies bodies(*solver, packing);
    const GrainView v = solver->view(Need::contacts);
    ASSERT_EQ(v.contacts.size(), 1U);
    const double torque = cross(v.contacts[0].point, v.contacts[0].force);
    ASSERT_GT(std::abs(torque), 1e-3);
    const double a2 = aspect, b2 = 1.0 / aspect;  // a b = 1
    const double inertia = std::numbers::pi * (a2 + b2) / 4.0;
    const test::Drive drive = test::drive_at(*solver, bodies, test::state_of(*solver));
    // M F'' spins alone: its moment about the centre is the torque.
    const Mat2 F = test::state_of(*solver).F[0], moment = drive.moment[0];
    const double about =
        cross(Vec2{F.col(0)}, Vec2{moment.col(0)}) + cross(Vec2{F.col(1)}, Vec2{moment.col(1)});
    EXPECT_NEAR(about, torque, 1e-9);
    const Mat2 rate = moment * bodies.inertia(0).cwiseInverse().asDiagonal();
    const double spin =
        0.5 * (cross(Vec2{F.col(0)}, Vec2{rate.col(0)}) + cross(Vec2{F.col(1)}, Vec2{rate.col(1)}));
    EXPECT_NEAR(spin, torque / inertia, 1e-9);
    EXPECT_NEAR(drive.force[0].y(), v.contacts[0].force.y(), 1e-9);
}

class FreeSpin : public testing::TestWithParam<const char*> {};

TEST_P(FreeSpin, GoesOnForever) {
    Scenario s = test::default_scenario(0.3);  // shape damping must spare it
    test::settings(s).set("kinematics", std::string(GetParam()));
    const Packing packing = one_ellipse(2.0, 0.3);
    auto solver = test::solver_for(s, packing);
    const test::Bodies bodies(*solver, packing);
    test::State state = test::state_of(*solver);
    const double rate = 0.05;
    state.F_rate[0] = rate * (Mat2() << 0.0, -1.0, 1.0, 0.0).finished() * state.F[0];
    test::set_state(*solver, state);
    const double momentum = test::momentum_of(*solver, bodies).angular;
    EXPECT_NEAR(momentum, rate * std::numbers::pi * (2.0 + 0.5) / 4.0, 1e-12);
    const double dt = 0.1;
    const int steps = 5000;
    for (int k = 0; k < steps; ++k) solver->advance(test::still(*solver), dt);
    EXPECT_NEAR(test::momentum_of(*solver, bodies).angular, momentum, 1e-12);
    // It has turned by rate t: centrifugal forces slow it by some rho (rate a)^2 / E.
    const Vec2 axis = test::state_of(*solver).F[0].col(0).normalized();
    const double turned =
        std::remainder(std::atan2(axis.y(), axis.x()) - 0.3 - rate * dt * steps, 2.0 * std::numbers::pi);
    EXPECT_NEAR(turned, 0.0, std::string_view(GetParam()) == "D2F0" ? 1e-3 : 0.3);
}
INSTANTIATE_TEST_SUITE_P(Kinematics, FreeSpin, testing::Values("D2F3", "D2F0"));

/// Two grains pressed between left and right, the second `ratio` times as hard, until rest.
std::unique_ptr<Solver> press_two(double ratio, double radius_2, double squeeze) {
    Scenario s = test::default_scenario(0.3);
    test::add_classes(s, ratio, 0.3);
    s.classes[1].material.density = ratio;  // the same sound speed, so that the hard one sets no tiny step
    const double width = 2.0 + 2.0 * radius_2;
    Packing p = test::packing_of(Box{{0.0, width, -20.0, 20.0}}, {{1.0, 0.0}, {2.0 + radius_2, 0.0}},
                                 {1.0, radius_2});
    p.grain_class = {0, 1};
    auto solver = test::solver_for(s, p);
    const double speed = 2e-3;
    while (solver->view(Need::base).box.width() > width - squeeze) {
        const double left = solver->view(Need::base).box.width() - (width - squeeze);
        const double dt = std::min(solver->stable_time_step(), std::max(left / (2.0 * speed), 1e-9));
        solver->advance(WallMotion{solver->view(Need::base).box, {speed, -speed, 0.0, 0.0}}, dt);
    }
    for (int k = 0; k < 4000; ++k) solver->advance(test::still(*solver), solver->stable_time_step());
    return solver;
}

TEST(Classes, TheSoftGrainTakesTheDeformation) {
    const auto soft_and_hard = press_two(1e4, 1.0, 0.2);
    soft_and_hard->check_finite();
    const test::State s = test::state_of(*soft_and_hard);
    EXPECT_NEAR((s.F[1] - Mat2::Identity()).norm(), 0.0, 1e-4);
    EXPECT_GT((s.F[0] - Mat2::Identity()).norm(), 1e-2);
    const GrainView v = soft_and_hard->view(Need::contacts);
    for (const GrainContact& c : v.contacts)
        EXPECT_NEAR(c.normal_force(), v.contacts[0].normal_force(), 1e-3 * v.contacts[0].normal_force());
    // Twice as hard: both give way, the soft one more.
    const test::State t = test::state_of(*press_two(2.0, 1.0, 0.2));
    const double first = (t.F[0] - Mat2::Identity()).norm(), second = (t.F[1] - Mat2::Identity()).norm();
    EXPECT_GT(first, 1.3 * second);
    EXPECT_GT(second, 0.1 * first);
}

TEST(Classes, AHardBigGrainIsAWall) {
    // Force of a unit disc against a plane wall, and against a disc 400 times as large and 1e6 as hard.
    Scenario s = test::undamped_scenario();
    const double depth = 0.02;
    const auto wall =
        test::solver_for(s, test::packing_of(Box{{0.0, 10.0, -20.0, 20.0}}, {{1.0 - depth, 0.0}}, {1.0}));
    test::add_classes(s, 1e6, 0.3);
    Packing p = test::packing_of(Box{{-5000.0, 5000.0, -5000.0, 5000.0}}, {{1.0 - depth, 0.0}, {-400.0, 0.0}},
                                 {1.0, 400.0});
    p.grain_class = {0, 1};
    const auto pair = test::solver_for(s, p);
    const double against_wall = wall->view(Need::contacts).contacts[0].normal_force();
    const double against_grain = pair->view(Need::contacts).contacts[0].normal_force();
    // The curvature R/400 widens the lens by 0.25 %, and its area likewise.
    EXPECT_NEAR(against_grain / against_wall, 1.0, 5e-3);
    EXPECT_NE(against_grain, against_wall);
}

TEST(DilationInertia, LeavesTheRestAloneAndTheSpin) {
    const auto pressed = [](double inertia) {
        Scenario s = test::default_scenario(0.49);
        test::settings(s).set("dilation_inertia", inertia);
        auto solver = test::solver_for(s, test::single_grain());
        test::close_to(*solver, 0.95, 1e-3);
        while (solver->view(Need::base).time < 400.0)
            solver->advance(test::still(*solver), solver->stable_time_step());
        EXPECT_LT(solver->view(Need::base).energy.kinetic, 1e-14);
        return solver;
    };
    const auto with = pressed(10.0), without = pressed(0.0);
    EXPECT_GT(with->stable_time_step(), 1.2 * without->stable_time_step());
    EXPECT_NEAR(with->wall_force()[1].x() / without->wall_force()[1].x(), 1.0, 1e-5);
    EXPECT_NEAR((test::state_of(*with).F[0] - test::state_of(*without).F[0]).norm(), 0.0, 1e-6);
}

TEST(DilationInertia, KeepsEnergyAndSpin) {
    Scenario s = test::undamped_scenario(0.49);
    test::settings(s).set("dilation_inertia", 10.0);
    const Packing packing = one_ellipse(1.5, 0.4);
    std::vector<double> errors, steps{0.02, 0.01};
    for (const double dt : steps) {
        auto solver = test::solver_for(s, packing);
        const test::Bodies bodies(*solver, packing);
        test::State state = test::state_of(*solver);
        state.F_rate[0] << 0.03, -0.05, 0.04, 0.02;
        test::set_state(*solver, state);
        const double momentum = test::momentum_of(*solver, bodies).angular;
        const double kinetic = solver->view(Need::base).energy.kinetic;
        double error = 0.0;
        while (solver->view(Need::base).time < 40.0) {
            solver->advance(test::still(*solver), dt);
            const EnergyLedger e = solver->view(Need::base).energy;
            error = std::max(error, std::abs(e.kinetic + e.elastic - kinetic) / kinetic);
        }
        RecordProperty(fmt::format("energy_{}", dt), fmt::format("{:.1e}", error));
        EXPECT_NEAR(test::momentum_of(*solver, bodies).angular, momentum, 1e-13);
        errors.push_back(error);
    }
    // The sway of a leap-frog at strains of 10 %: of second order, as there is no drift.
    EXPECT_LT(errors[0], 2e-3);
    EXPECT_GT(test::order_of(errors, steps), 1.8);
}

TEST(DilationInertia, SlowsTheBreathingOfAGrainAsItSays) {
    // omega^2 = 8 u''(1) / (rho R^2) / (1 + sigma), with u'' = kappa + mu/3 of the neo-Hookean grain.
    for (double sigma : {0.0, 3.0}) {
        Scenario s = test::undamped_scenario();
        test::settings(s).set("dilation_inertia", sigma);
        auto solver = test::solver_for(s, test::packing_of(test::far_away(), {Vec2::Zero()}, {1.0}));
        test::State state = test::state_of(*solver);
        state.F[0] *= 1.0 + 1e-5;
        test::set_state(*solver, state);
        const double omega = test::free_frequency(*solver, 0.01, 3000);
        const double h = 1e-3, mu = 1.0 / 2.6, kappa = 1.0 / 1.2;
        const double stiffness =
            -test::slope([&](double d) { return LensPotential::pressure(1.0 + d, mu, kappa); }, h);
        EXPECT_NEAR(omega, std::sqrt(8.0 * stiffness / (1.0 + sigma)), 2e-4 * omega) << "sigma " << sigma;
    }
}

}  // namespace
}  // namespace softgrain::sdem
