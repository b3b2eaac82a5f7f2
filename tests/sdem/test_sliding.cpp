// Contacts that stick, slip and adhere, against closed forms.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit_pair.hpp"

namespace softgrain::sdem {
namespace {

/// Grains that keep their shape, without dashpots: what is left is the contact law.
Scenario rigid(double friction, double cohesion = 0.0, double range = 0.0) {
    Scenario s = test::default_scenario(0.3);
    test::switch_off_damping(s);
    test::settings(s).set("kinematics", std::string("D2F0"));
    test::settings(s).set("adhesion_range", range);
    s.material.friction = s.material.wall_friction = friction;
    s.material.cohesion = cohesion;
    return s;
}
/// A unit disc between bottom and top, pressed by `depth` on both sides.
Packing pressed(double depth) {
    return test::packing_of(Box{{-50.0, 50.0, -1.0 + depth, 1.0 - depth}}, {Vec2::Zero()}, {1.0});
}
std::unique_ptr<Solver> dragged(const Scenario& s, double depth, double speed) {
    auto solver = test::solver_for(s, pressed(depth));
    test::State state = test::state_of(*solver);
    state.velocity[0] = {speed, 0.0};
    test::set_state(*solver, state);
    return solver;
}

constexpr double mass = std::numbers::pi;
constexpr double spring = 0.5;  // sdem.tangential_stiffness times E

/// With nothing in reach at the start there was no place to remember a spring in, and the first contact ended
/// the program.
TEST(Friction, GrainsThatMeetLateRemember) {
    Scenario s = test::default_scenario(0.3);
    s.material.friction = s.material.wall_friction = 0.5;
    auto solver = test::solver_for(
        s, test::packing_of(Box{{-10.0, 10.0, -10.0, 10.0}}, {{-5.0, 0.0}, {5.0, 0.3}}, {1.0, 1.0}));
    EXPECT_TRUE(solver->view(Need::contacts).contacts.empty());
    test::State state = test::state_of(*solver);
    state.velocity = {{0.1, 0.1}, {-0.1, 0.1}};
    test::set_state(*solver, state);
    const WallMotion walls = test::still(*solver);
    bool pair = false, wall = false, drags = false;
    for (int k = 0; k < 4000; ++k) {
        solver->advance(walls, 0.05);
        for (const GrainContact& c : solver->view(Need::contacts).contacts) {
            (c.with_wall() ? wall : pair) = true;
            drags = drags || std::abs(c.force.dot(perpendicular(c.normal))) > 0.0;
        }
    }
    EXPECT_TRUE(pair && wall && drags);
    EXPECT_GT(solver->view(Need::base).energy.friction, 0.0);
}

TEST(Friction, AStickingGrainSwingsOnItsTwoSprings) {
    const double friction = 0.5, speed = 1e-4, omega = std::sqrt(2.0 * spring / mass);
    const auto solver = dragged(rigid(friction), 0.05, speed);
    const double dt = 0.02;
    for (int k = 1; k <= 1000; ++k) {
        solver->advance(test::still(*solver), dt);
        // (omega dt)^2 / 24 shifts the frequency by 5e-6: 1e-4 of the amplitude after two periods.
        EXPECT_NEAR(test::state_of(*solver).position[0].x(), speed / omega * std::sin(omega * dt * k),
                    2e-4 * speed / omega);
    }
    const EnergyLedger e = solver->view(Need::base).energy;
    EXPECT_EQ(e.friction, 0.0);
}

TEST(Friction, ASlippingGrainIsSlowedByTwoMuN) {
    const double friction = 0.2, speed = 0.02, depth = 0.05;
    const auto solver = dragged(rigid(friction), depth, speed);
    const double N = -solver->wall_force()[2].y(), dt = 0.02;
    ASSERT_GT(N, 1e-3);
    const EnergyLedger start = solver->view(Need::base).energy;
    const double omega = std::sqrt(2.0 * spring / mass);
    // Spring phase until the force on each side is mu N, then constant deceleration.
    const double slip_at = friction * N / spring;
    const double t_slip = std::asin(slip_at * omega / speed) / omega;
    const double v_slip = speed * std::cos(omega * t_slip), deceleration = 2.0 * friction * N / mass;
    double time = 0.0;
    int compared = 0;
    while (v_slip - deceleration * (time - t_slip) > 0.02 * speed) {
        solver->advance(test::still(*solver), dt);
        time += dt;
        if (time < t_slip + dt) continue;
        const double t = time - t_slip;
        EXPECT_NEAR(test::state_of(*solver).position[0].x(),
                    slip_at + v_slip * t - 0.5 * deceleration * t * t, 1e-3 * speed);
        for (const GrainContact& c : solver->view(Need::contacts).contacts)
            EXPECT_NEAR(std::abs(c.force.x()), friction * N, 1e-12);
        ++compared;
    }
    EXPECT_GT(compared, 100);
    // Then it sticks and swings about where it stopped: what is not in the spring or in motion was lost.
    for (int k = 0; k < 500; ++k) solver->advance(test::still(*solver), dt);
    const EnergyLedger e = solver->view(Need::base).energy;
    const double in_springs = friction * N * friction * N / spring;  // two springs at the cap
    EXPECT_NEAR(e.friction, 0.5 * mass * speed * speed - in_springs, 2e-3 * start.kinetic);
    EXPECT_NEAR(e.kinetic + e.elastic + e.friction, start.kinetic + start.elastic, 1e-3 * start.kinetic);
    EXPECT_EQ(test::state_of(*solver).position[0].y(), 0.0);
    EXPECT_NEAR(test::state_of(*solver).F[0](1, 0), 0.0, 1e-15);  // both walls turn it alike
}

/// Two discs pressed together, spinning; free to fly apart.
struct Pair {
    Packing packing = test::packing_of(test::far_away(), {{-0.97, 0.1}, {0.97, -0.1}}, {1.0, 1.0});
    std::unique_ptr<Solver> solver;
    test::Bodies bodies;

    Pair(const Scenario& s, double spin_1, double spin_2)
        : solver(test::solver_for(s, packing)), bodies(*solver, packing) {
        test::State state = test::state_of(*solver);
        state.F_rate[0] << 0.0, -spin_1, spin_1, 0.0;
        state.F_rate[1] << 0.0, -spin_2, spin_2, 0.0;
        test::set_state(*solver, state);
    }
    double spin(std::size_t g) const {
        const test::State s = test::state_of(*solver);
        return 0.5 * (cross(Vec2{s.F[g].col(0)}, Vec2{s.F_rate[g].col(0)}) +
                      cross(Vec2{s.F[g].col(1)}, Vec2{s.F_rate[g].col(1)}));
    }
};

TEST(Friction, GrainsThatRollOnEachOtherLoseNothing) {
    Pair pair(rigid(0.5), 0.05, -0.05);
    for (int k = 0; k < 200; ++k) pair.solver->advance(test::still(*pair.solver), 0.02);
    EXPECT_NEAR(pair.spin(0), 0.05, 1e-12);
    EXPECT_NEAR(pair.spin(1), -0.05, 1e-12);
    EXPECT_LT(pair.solver->view(Need::base).energy.friction, 1e-20);
}

class Rubbing : public testing::TestWithParam<const char*> {};

TEST_P(Rubbing, KeepsMomentaAndClosesTheLedger) {
    Scenario s = rigid(0.3);
    test::settings(s).set("kinematics", std::string(GetParam()));
    std::vector<double> residuals;
    for (double dt : {0.02, 0.01}) {
        Pair pair(s, 0.2, 0.1);
        const test::Momentum before = test::momentum_of(*pair.solver, pair.bodies);
        const EnergyLedger start = pair.solver->view(Need::base).energy;
        double friction = 0.0, worst = 0.0;
        for (double time = 0.0; time < 12.0; time += dt) {
            pair.solver->advance(test::still(*pair.solver), dt);
            const EnergyLedger e = pair.solver->view(Need::base).energy;
            EXPECT_GE(e.friction, friction);
            friction = e.friction;
            worst = std::max(worst, std::abs(test::residual(e, start.kinetic + start.elastic)));
        }
        const test::Momentum after = test::momentum_of(*pair.solver, pair.bodies);
        EXPECT_NEAR((after.linear - before.linear).norm(), 0.0, 1e-14);
        EXPECT_NEAR(after.angular, before.angular, 1e-14);
        EXPECT_GT(friction, 0.05 * start.kinetic);
        EXPECT_LT(pair.spin(0) + pair.spin(1), 0.29);         // less slip than before
        EXPECT_NEAR(pair.spin(0) - pair.spin(1), 0.1, 0.02);  // friction turns both alike
        residuals.push_back(worst / start.kinetic);
        RecordProperty(fmt::format("residual_{}", dt), fmt::format("{:.1e}", residuals.back()));
    }
    // The force at slip is that at the end of a step: an error of first order.
    EXPECT_LT(residuals[0], 1e-2);
    EXPECT_LT(residuals[1], 0.65 * residuals[0]);
}
INSTANTIATE_TEST_SUITE_P(Kinematics, Rubbing, testing::Values("D2F0", "D2F3"));

TEST(Cohesion, PullsByItsStressTimesTheChord) {
    const auto force_with = [](double cohesion) {
        const auto solver = test::solver_for(rigid(0.0, cohesion), pressed(0.01));
        const GrainView v = solver->view(Need::contacts);
        EXPECT_EQ(v.contacts.size(), 2U);
        return std::pair{v.contacts[0].normal_force(), v.contacts[0].length};
    };
    const double cohesion = 0.02;
    const auto without = force_with(0.0), with = force_with(cohesion);
    EXPECT_NEAR(with.first, without.first - cohesion * without.second, 1e-14);
    // Eq. of the half chord at depth 0.01.
    EXPECT_NEAR(with.second, 2.0 * std::sqrt(0.01 * 1.99), 1e-12);
}

/// Walls out and in again (or the other way) by `depth` each in `steps` steps, slowly enough for rest.
EnergyLedger open_and_close(Solver& solver, double depth, double speed, int loops) {
    const double dt = 0.05;
    const int steps = static_cast<int>(std::lround(depth / (speed * dt)));
    for (int loop = 0; loop < loops; ++loop)
        for (double sign : {-1.0, 1.0})
            for (int k = 0; k < steps; ++k) {
                const double v = sign * depth / (steps * dt);
                solver.advance(WallMotion{solver.view(Need::base).box, {0.0, 0.0, v, -v}}, dt);
            }
    return solver.view(Need::base).energy;
}

TEST(Cohesion, WithoutAMemoryItGivesBackWhatItTook) {
    const double cohesion = 0.02;
    const auto solver = test::solver_for(rigid(0.0, cohesion), pressed(0.02));
    const double before = solver->view(Need::base).energy.elastic;
    const EnergyLedger e = open_and_close(*solver, 0.04, 2e-4, 1);
    EXPECT_EQ(e.dissipated(), 0.0);
    EXPECT_NEAR(e.elastic, before, 1e-12);
    // Work out: -U; the steps' error on the way is (speed dt)^2.
    EXPECT_NEAR(e.external_work, 0.0, 1e-5 * cohesion * 0.02);
}

TEST(Cohesion, AMemoryCostsTheAreaOfItsLoop) {
    // Adhesion is a slider between 0 and the cohesion, driven by the loss of overlap S, range A0 long:
    // opening from S costs cohesion (S - range A0 / 2) at each wall, and closing nothing.
    const double cohesion = 0.02, range = 5e-4, depth = 0.02;
    const auto solver = test::solver_for(rigid(0.0, cohesion, range), pressed(depth));
    const double half = std::acos(1.0 - depth), S = half - std::sin(half) * std::cos(half);
    const double area = std::numbers::pi;
    ASSERT_GT(S, 2.0 * range * area);
    const double expected = 2.0 * cohesion * (S - 0.5 * range * area);
    const double initial = solver->view(Need::base).energy.elastic;
    const EnergyLedger once = open_and_close(*solver, 0.04, 2e-4, 1);
    EXPECT_NEAR(once.adhesion, expected, 2e-3 * expected);
    EXPECT_NEAR(once.external_work, expected, 2e-3 * expected);
    EXPECT_NEAR(once.elastic, initial, 1e-12);
    const EnergyLedger twice = open_and_close(*solver, 0.04, 2e-4, 1);
    EXPECT_NEAR(twice.adhesion, 2.0 * once.adhesion, 2e-3 * expected);
}

TEST(Cohesion, TwoGrainsHoldTogetherUntilTheyArePulledApart) {
    // Largest pull of the rigid pair from the law itself: max over the overlap of (cohesion - q) L.
    const double cohesion = 0.03;
    const auto pull_at = [&](double distance) {
        const auto solver =
            test::solver_for(rigid(0.0, cohesion),
                             test::packing_of(test::far_away(), {{0.0, 0.0}, {distance, 0.0}}, {1.0, 1.0}));
        const GrainView v = solver->view(Need::contacts);
        return v.contacts.empty() ? 0.0 : -v.contacts[0].normal_force();
    };
    double largest = 0.0;
    for (double distance = 1.95; distance < 2.0; distance += 1e-4)
        largest = std::max(largest, pull_at(distance));
    double by_hand = 0.0;
    for (double distance = 1.95; distance < 2.0; distance += 1e-4) {
        const double overlap = 2.0 - distance, L = 2.0 * std::sqrt(overlap * (1.0 - 0.25 * overlap));
        by_hand = std::max(by_hand, cohesion * L - test::unit_pair_force(overlap, 0.3));
    }
    EXPECT_NEAR(largest, by_hand, 1e-9);
    EXPECT_GT(largest, 1e-4);
    // Released at the touching distance they stay together.
    const auto solver = test::solver_for(
        rigid(0.0, cohesion), test::packing_of(test::far_away(), {{0.0, 0.0}, {1.99, 0.0}}, {1.0, 1.0}));
    for (int step = 0; step < 2000; ++step) solver->advance(test::still(*solver), 0.05);
    EXPECT_EQ(solver->view(Need::contacts).contacts.size(), 1U);
}

}  // namespace
}  // namespace softgrain::sdem
