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
    std::vector<double> mean;  ///< energy error, mean over each quarter of the run
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
        mean.assign(4, 0.0);
        for (int k = 0; k < samples; ++k) {
            for (int step = 0; step < 50; ++step)
                solver->advance(test::still(*solver), solver->stable_time_step());
            const EnergyLedger e = solver->view(Need::base).energy;
            const double now = e.kinetic + e.elastic - start.kinetic - start.elastic;
            kinetic += e.kinetic / samples;
            error = std::max(error, std::abs(now));
            mean[static_cast<std::size_t>(4 * k / samples)] += 4.0 * now / samples;
        }
        momentum_change = test::momentum_of(*solver, bodies).linear - momentum;
    }
    double drift() const { return std::abs(mean[3] - mean[0]) / kinetic; }
};

struct Mixture {
    double nu, radius;
};

class Conservation : public testing::TestWithParam<Mixture> {};

TEST_P(Conservation, EnergyOfAnUndampedPeriodicPackingOver100000DefaultSteps) {
    const Gas gas(GetParam().nu, GetParam().radius, std::nullopt, 100000);
    RecordProperty("largest", fmt::format("{:.1e}", gas.error / gas.kinetic));
    RecordProperty("drift", fmt::format("{:.1e}", gas.drift()));
    EXPECT_LT(gas.error, 1e-3 * gas.kinetic);
    EXPECT_LT(gas.momentum_change.norm(), 1e-13);
}

// From a gas (phi0 = 0.79) to a packing at phi0 = 1.13.
INSTANTIATE_TEST_SUITE_P(Gases, Conservation,
                         testing::Values(Mixture{0.0, 1.1}, Mixture{0.3, 1.0}, Mixture{0.5, 1.2}),
                         [](const auto& mixture) {
                             return fmt::format("nu{}_radius{}", std::lround(100.0 * mixture.param.nu),
                                                std::lround(100.0 * mixture.param.radius));
                         });

TEST(LongSteps, MakeTheEnergySway) {
    // The energy read off a leap-frog sways with (omega dt)^2: what a damped run's step would do here.
    const Gas gas(0.3, 1.0, 0.7, 100000);
    RecordProperty("largest", fmt::format("{:.1e}", gas.error / gas.kinetic));
    RecordProperty("drift", fmt::format("{:.1e}", gas.drift()));
    EXPECT_LT(gas.error, 0.25 * gas.kinetic);
    EXPECT_LT(gas.drift(), 0.05);
    EXPECT_LT(gas.momentum_change.norm(), 1e-13);
}

}  // namespace
}  // namespace softgrain::sdem
