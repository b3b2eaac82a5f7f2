// What the conservative law is for: energy and momenta over time.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"

namespace softgrain::sdem {
namespace {

/// Four unequal grains flying into each other, spinning.
struct Flight {
    Packing packing = test::packing_of(test::far_away(), {{-1.6, 0.1}, {1.5, -0.2}, {0.1, 1.7}, {-0.2, -1.8}},
                                       {1.0, 0.8, 0.9, 0.6});
    std::unique_ptr<Solver> solver;

    explicit Flight(const Scenario& s) : solver(test::solver_for(s, packing)) {
        test::State state = test::state_of(*solver);
        state.velocity = {{0.1, 0.0}, {-0.08, 0.01}, {0.0, -0.1}, {0.02, 0.09}};
        state.F_rate[0] << 0.0, -0.05, 0.05, 0.0;
        test::set_state(*solver, state);
    }
};

class Collision : public testing::TestWithParam<const char*> {};

TEST_P(Collision, EnergyIsKeptToTheSquareOfTheStepAndMomentaToRounding) {
    Scenario s = test::default_scenario(0.3);
    test::switch_off_damping(s);
    test::settings(s).set("kinematics", std::string(GetParam()));
    std::vector<double> errors, steps;
    for (double dt : {0.08, 0.04, 0.02}) {
        Flight flight(s);
        const test::Bodies bodies(*flight.solver, flight.packing);
        const double initial = flight.solver->view(Need::base).energy.kinetic;
        const test::Momentum before = test::momentum_of(*flight.solver, bodies);
        double error = 0.0, stored = 0.0;
        for (double time = 0.0; time < 24.0; time += dt) {
            flight.solver->advance(test::still(*flight.solver), dt);
            const EnergyLedger e = flight.solver->view(Need::base).energy;
            error = std::max(error, std::abs(e.kinetic + e.elastic - initial) / initial);
            stored = std::max(stored, e.elastic / initial);
        }
        const test::Momentum after = test::momentum_of(*flight.solver, bodies);
        EXPECT_NEAR((after.linear - before.linear).norm(), 0.0, 1e-14);
        EXPECT_NEAR(after.angular, before.angular, 1e-13);
        EXPECT_GT(stored, 0.2);  // they did collide
        EXPECT_EQ(flight.solver->view(Need::base).energy.dissipated(), 0.0);
        errors.push_back(error);
        steps.push_back(dt);
        RecordProperty(fmt::format("error_{}", dt), fmt::format("{:.1e}", error));
    }
    EXPECT_LT(errors[1], 6e-4);                     // 0.04 R sqrt(rho/E)
    EXPECT_GT(test::order_of(errors, steps), 1.5);  // largest errors, met at other moments with other steps
}
INSTANTIATE_TEST_SUITE_P(Kinematics, Collision, testing::Values("D2F3", "D2F1", "D2F0"));

TEST(Ledger, ResidualOfADampedCompactionFallsWithTheSquareOfTheStep) {
    std::vector<double> errors, steps;
    for (double safety : {0.8, 0.4, 0.2}) {
        Scenario s = test::default_scenario(0.3);
        test::settings(s).set("safety", safety);
        auto solver = test::solver_for(s, test::packing24());
        const double largest = test::residual_while_closing(*solver, 9.7, 9.25, 0.05, 0.01);
        const EnergyLedger e = solver->view(Need::base).energy;
        EXPECT_GT(e.external_work, 0.02);
        EXPECT_GT(e.damping, 0.0);
        errors.push_back(largest / e.external_work);
        steps.push_back(safety);
        RecordProperty(fmt::format("safety_{}", safety), fmt::format("{:.1e}", errors.back()));
    }
    EXPECT_LT(errors[0], 2e-4);
    EXPECT_GT(test::order_of(errors, steps), 1.7);
}

TEST(Ledger, TheReturnOfAClosedElasticLoopIsItsWork) {
    // Two walls in and out again, slowly and without damping. What is not given back is the motion left.
    Scenario s = test::default_scenario(0.3);
    test::switch_off_damping(s);
    test::settings(s).set("safety", 0.8);
    auto solver = test::solver_for(s, test::single_grain());
    const double half_period = 4000.0, amplitude = 0.1;
    const int steps = 24000;
    const double dt = half_period / steps;
    ASSERT_LT(dt, solver->stable_time_step());
    double most = 0.0;
    for (int k = 0; k < 2 * steps; ++k) {
        // Wall displacement amplitude (1 - cos(pi t / T))/2: no jump of the speed.
        const double phase = std::numbers::pi * (k + 0.5) / steps;
        const double speed = 0.5 * amplitude * std::numbers::pi / half_period * std::sin(phase);
        solver->advance(WallMotion{solver->view(Need::base).box, {speed, -speed, 0.0, 0.0}}, dt);
        most = std::max(most, solver->view(Need::base).energy.external_work);
    }
    const EnergyLedger e = solver->view(Need::base).energy;
    EXPECT_NEAR(solver->view(Need::base).box.width(), 1.0, 1e-9);
    EXPECT_GT(most, 5e-3);
    EXPECT_EQ(e.dissipated(), 0.0);
    EXPECT_LT(std::abs(e.external_work), 1e-6 * most);
    RecordProperty("lost", fmt::format("{:.1e}", e.external_work / most));
}

}  // namespace
}  // namespace softgrain::sdem
