// Energy and momentum over many steps without damping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "probe.hpp"

namespace softgrain::sdem {
namespace {

/// A periodic packing of 24 grains that swing and fly about without damping, after coming to rest under it.
struct Gas {
    Packing packing = test::packing24();
    std::unique_ptr<Solver> solver;
    double error = 0.0, kinetic = 0.0;
    Vec2 momentum_change;

    /// radius: of the grains, in units of packing24's.
    Gas(double nu, double radius, std::optional<double> safety, int steps) {
        packing.box.periodic = true;
        for (double& R : packing.radius) R *= radius;
        Scenario s = test::default_scenario(nu);
        const auto damped = test::solver_for(s, packing);
        for (int k = 0; k < 10000; ++k) damped->advance(test::still(*damped), damped->stable_time_step());
        test::State state = test::state_of(*damped);

        test::switch_off_damping(s);
        if (safety) test::settings(s).set("safety", *safety);
        solver = test::solver_for(s, packing);
        const test::Bodies bodies(*solver, packing);
        for (std::size_t g = 0; g < packing.size(); ++g) {
            const auto k = static_cast<double>(g);
            state.velocity[g] = 0.01 * Vec2{std::cos(2.3 * k), std::sin(1.1 * k)};
        }
        test::set_state(*solver, state);
        const Vec2 momentum = test::momentum_of(*solver, bodies).linear;
        const EnergyLedger start = solver->view(Need::base).energy;
        const int samples = steps / 50;
        for (int k = 0; k < samples; ++k) {
            for (int step = 0; step < 50; ++step)
                solver->advance(test::still(*solver), solver->stable_time_step());
            const EnergyLedger e = solver->view(Need::base).energy;
            const double now = e.kinetic + e.elastic - start.kinetic - start.elastic;
            kinetic += e.kinetic / samples;
            error = std::max(error, std::abs(now));
        }
        momentum_change = test::momentum_of(*solver, bodies).linear - momentum;
    }
};

struct Mixture {
    double nu, radius;
};

class DefaultStep : public testing::TestWithParam<Mixture> {};

TEST_P(DefaultStep, KeepsTheEnergyOfAnUndampedPeriodicPackingOver100000Steps) {
    const Gas gas(GetParam().nu, GetParam().radius, std::nullopt, 100000);
    RecordProperty("largest", fmt::format("{:.1e}", gas.error / gas.kinetic));
    EXPECT_LT(gas.error, 1e-3 * gas.kinetic);
    EXPECT_LT(gas.momentum_change.norm(), 1e-13);
}

// From a gas (phi0 = 0.79) to a packing at phi0 = 1.13.
INSTANTIATE_TEST_SUITE_P(Gases, DefaultStep,
                         testing::Values(Mixture{0.0, 1.1}, Mixture{0.3, 1.0}, Mixture{0.5, 1.2}),
                         [](const auto& mixture) {
                             return fmt::format("nu{}_radius{}", std::lround(100.0 * mixture.param.nu),
                                                std::lround(100.0 * mixture.param.radius));
                         });

TEST(Conservation, TheSwayFallsWithTheSquareOfTheStep) {
    std::vector<double> errors, steps{0.28, 0.14, 0.07};
    for (const double safety : steps) {
        const Gas gas(0.3, 1.0, safety, 30000);
        errors.push_back(gas.error / gas.kinetic);
        RecordProperty(fmt::format("safety_{}", safety), fmt::format("{:.1e}", errors.back()));
    }
    EXPECT_GT(test::order_of(errors, steps), 1.5);  // largest errors, met at other moments with other steps
}

}  // namespace
}  // namespace softgrain::sdem
