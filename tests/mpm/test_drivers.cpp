// What holds whichever way grains are moved: restarts, threads, looking, ledgers; and contact on the common
// grid.
#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "tests/mpm/solver.hpp"
#include "tests/support/same_bits.hpp"
#include "tests/support/stop_later.hpp"

namespace softgrain::mpm {
namespace {

using softgrain::testing::expect_restart_keeps_bits;
using softgrain::testing::expect_threads_keep_bits;
using softgrain::testing::same_bits;
using softgrain::testing::saved;
using softgrain::testing::seconds_since;
using softgrain::testing::StopLater;

struct Driver {
    std::string name, driver, contact;
    double friction;  ///< also of walls
    double yield_stress;
    double ledger;  ///< energy residual / work
};

void PrintTo(const Driver& driver, std::ostream* out) {
    *out << driver.name;
}

class Drivers : public ::testing::TestWithParam<Driver> {
  protected:
    static Packing packing() {
        Packing p;
        p.box.position = {0.0, 4.02, 0.0, 4.02};
        p.center = {{1.0, 1.0}, {3.0, 1.02}, {1.01, 3.0}, {3.02, 3.01}};
        p.radius = {1.0, 0.98, 0.99, 1.0};
        return p;
    }
    static std::unique_ptr<Solver> make() {
        Scenario scenario = test::scenario_with(0.3, 6);
        Settings& settings = test::settings(scenario);
        settings.set("driver", GetParam().driver);
        settings.set("contact", GetParam().contact);
        scenario.material.friction = scenario.material.wall_friction = GetParam().friction;
        if (GetParam().yield_stress > 0.0) scenario.material.yield_stress = GetParam().yield_stress;
        return method().make(scenario, packing());
    }
    /// Squeezed by the walls at unequal speeds.
    static Box squeeze(Solver& solver, Box box, int steps) {
        for (int k = 0; k < steps; ++k) {
            const WallMotion walls{box, {0.005, -0.002, 0.004, -0.006}};
            const double dt = 0.5;
            solver.advance(walls, dt);
            box = walls.after(dt);
        }
        return box;
    }
};

INSTANTIATE_TEST_SUITE_P(Mpm, Drivers,
                         ::testing::Values(
                             // By construction of the ledger, to rounding.
                             Driver{"quasi_static", "quasi_static", "surface", 0.0, 0.0, 1e-10},
                             Driver{"quasi_static_plastic", "quasi_static", "surface", 0.0, 0.02, 1e-10},
                             Driver{"implicit", "implicit", "surface", 0.5, 0.0, 1e-10},
                             // Of leap-frog, and of contacts that open and close in a step.
                             Driver{"explicit_rubbing", "explicit", "surface", 0.5, 0.0, 0.01},
                             Driver{"explicit_plastic", "explicit", "surface", 0.3, 0.02, 0.02},
                             Driver{"common_grid", "explicit", "common_grid", 0.3, 0.0, 0.06}),
                         [](const auto& instance) { return instance.param.name; });

TEST_P(Drivers, ARestartedRunHasTheSameBits) {
    expect_restart_keeps_bits([&] { return make(); },
                              [&](Solver& solver) { return squeeze(solver, packing().box, 12); },
                              [&](Solver& solver, const Box& box) { squeeze(solver, box, 8); });
}

TEST_P(Drivers, TwoThreadsGiveTheBitsOfOne) {
    expect_threads_keep_bits([&] { return make(); }, {1, 2},
                             [&](Solver& solver) {
                                 squeeze(solver, packing().box, 12);
                                 solver.view(Need::all | Need::parts);
                             });
}

TEST_P(Drivers, LookingChangesNothing) {
    const auto watched = make(), alone = make();
    Box box = packing().box;
    for (int k = 0; k < 12; ++k) {
        watched->view(Need::all | Need::parts);
        const Box next = squeeze(*watched, box, 1);
        squeeze(*alone, box, 1);
        box = next;
    }
    EXPECT_TRUE(same_bits(saved(*watched), saved(*alone)));
}

/// In the middle of a step of many parts: the step is taken back, and made anew with the same bits.
TEST_P(Drivers, AStopWithinAStepTakesItBack) {
    if (GetParam().driver == "explicit") GTEST_SKIP() << "its steps are short";
    const auto straight = make(), stopped = make();
    for (Solver* solver : {straight.get(), stopped.get()}) squeeze(*solver, packing().box, 1);
    const Box box = stopped->view(Need::base).box;
    const WallMotion walls{box, {0.02, -0.02, 0.02, -0.02}};
    const double dt = 10.0;
    const Checkpoint before = saved(*stopped);
    const auto begin = std::chrono::steady_clock::now();
    straight->advance(walls, dt);
    const double whole = seconds_since(begin);
    {
        const StopLater stop(0.1 * whole);
        EXPECT_THROW(stopped->advance(walls, dt), StopAsked);
    }
    EXPECT_TRUE(same_bits(before, saved(*stopped)));
    stopped->advance(walls, dt);
    EXPECT_TRUE(same_bits(saved(*straight), saved(*stopped)));
}

TEST_P(Drivers, TheLedgerClosesAndFrictionTakesItsShare) {
    const auto solver = make();
    squeeze(*solver, packing().box, 40);
    const EnergyLedger energy = solver->view(Need::all).energy;
    EXPECT_GT(energy.external_work, 1e-4);
    EXPECT_NEAR(energy.kinetic + energy.elastic + energy.dissipated(), energy.external_work,
                GetParam().ledger * energy.external_work);
    if (GetParam().friction > 0.0) {
        EXPECT_GT(energy.friction, 1e-4 * energy.external_work);
    } else {
        EXPECT_EQ(energy.friction, 0.0);
    }
    if (GetParam().yield_stress > 0.0) {
        EXPECT_GT(energy.plastic, 0.1 * energy.external_work);
    }
}

/// Two grains and walls: on the surfaces they touch at once, on the common grid a cell before.
TEST(CommonGrid, WallsPressBeforeTheyTouch) {
    // Cells of 1/4 of a radius of 1, walls half a cell away.
    const double away = 0.125;
    for (const bool common : {false, true}) {
        Scenario scenario = test::scenario_with(0.3, 8);
        test::settings(scenario).set("driver", std::string("explicit"));
        if (common) test::settings(scenario).set("contact", std::string("common_grid"));
        Packing packing;
        packing.center = {{0.0, 0.0}};
        packing.radius = {1.0};
        packing.box.position = {-3.0, 3.0, -1.0 - away, 1.0 + away};
        const auto solver = method().make(scenario, packing);
        double pressed = 0.0;
        Box box = packing.box;
        for (int k = 0; k < 20; ++k) {
            const WallMotion walls{box, {0.0, 0.0, 0.01, -0.01}};
            solver->advance(walls, 0.5);
            box = walls.after(0.5);
            pressed = std::max(pressed, solver->wall_force()[3].y());
        }
        // Walls are still 0.025 away.
        EXPECT_EQ(pressed > 1e-4, common);
    }
}

TEST(CommonGrid, IsRefusedByImplicitDrivers) {
    Scenario scenario = test::scenario_with(0.3, 8);
    test::settings(scenario).set("contact", std::string("common_grid"));
    EXPECT_THROW((void)method().make(scenario, test::one_grain(true)), InputError);
}

/// Two walls at each step shut by a tenth of the box, far more than a step should be: smaller ones are made
/// of it.
TEST(HardCases, AWallStepThatIsTooLargeIsDivided) {
    for (const char* driver : {"quasi_static", "implicit", "explicit"}) {
        Scenario scenario = test::scenario_with(0.3, 8);
        test::settings(scenario).set("driver", std::string(driver));
        test::settings(scenario).set("strain_step", 0.1);
        const auto solver = method().make(scenario, test::one_grain(true));
        test::close_in(*solver, 0.85, true);
        EXPECT_GT(solver->wall_force()[3].y(), 0.05) << driver;
        solver->check_finite();
    }
}

}  // namespace
}  // namespace softgrain::mpm
