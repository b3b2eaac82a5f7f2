// Gravity in every method: free fall, weight on the floor, stress and energy of a column, restart.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "common/observables/stress.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain {
namespace {

using namespace testing;

class Gravity : public ::testing::TestWithParam<Bands> {
  protected:
    /// With this acceleration times stress scale / (rho R).
    std::unique_ptr<Solver> solver_for(const Packing& packing, const Vec2& gravity) const {
        Scenario scenario = scenario_of(GetParam().method);
        const double scale = make(GetParam(), scenario, packing)->stress_scale();
        scenario.box.gravity = scale * gravity;
        return make(GetParam(), scenario, packing);
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, Gravity, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

Packing apart() {
    Packing p;
    p.box.position = {0.0, 12.0, 0.0, 12.0};
    p.center = {{4.0, 4.5}, {7.5, 7.0}};
    p.radius = {1.0, 0.8};
    return p;
}

/// Three discs on top of each other between walls that do not touch them.
Packing column() {
    Packing p;
    p.box.position = {0.0, 2.5, 0.0, 7.0};
    p.center = {{1.25, 1.0}, {1.25, 3.0}, {1.25, 5.0}};
    p.radius = {1.0, 1.0, 1.0};
    return p;
}

double weight_of(const GrainView& view) {
    double mass = 0.0;
    for (const double m : view.mass) mass += m;
    return -mass * view.gravity.y();
}

/// x_N = x_0 + g t^2 / 2 of a first kick by half a step, + g t dt / 2 more of a whole one.
TEST_P(Gravity, FreeFallIsThatOfTheLeapFrog) {
    constexpr int steps = 200;
    const Packing packing = apart();
    Scenario scenario = scenario_of(GetParam().method);
    const double dt = 0.5 * make(GetParam(), scenario, packing)->stable_time_step(), time = steps * dt;
    scenario.box.gravity = Vec2{0.5, -2.0} / (time * time);
    const auto solver = make(GetParam(), scenario, packing);
    const GrainView start = solver->view(Need::base);
    const std::vector<Vec2> from(start.centroid.begin(), start.centroid.end());
    for (int k = 0; k < steps; ++k) solver->advance({packing.box, {}}, dt);
    const GrainView view = solver->view(Need::contacts);
    const Vec2 way = 0.5 * view.gravity * time * (time + (2.0 * GetParam().first_kick - 1.0) * dt);
    double error = 0.0;
    for (std::size_t g = 0; g < view.size(); ++g)
        error = std::max(error, (view.centroid[g] - from[g] - way).norm() / way.norm());
    RecordProperty("error", fmt::format("{:.1e}", error));
    EXPECT_LE(error, GetParam().fall);
    EXPECT_NEAR(unbalanced_force(view), 1.0, 1e-9) << "nothing but weight";
    const double work = weight_of(view) / -view.gravity.y() * view.gravity.dot(way);
    EXPECT_NEAR(view.energy.external_work, work, 2.0 * GetParam().fall * work);
    // A first kick by a whole step leaves v_N^2 / 2 = g x_N N / (N + 1), or the half of it ahead.
    EXPECT_NEAR(view.energy.kinetic + view.energy.elastic, work, 1.5 / steps * work);
}

/// Means over the last fifth, for aggregates tremble.
TEST_P(Gravity, AColumnRestsOnItsFloor) {
    const Packing packing = column();
    const auto solver = solver_for(packing, {0.0, -2e-3});
    const double settle = 2.0 * GetParam().loading_time / std::sqrt(solver->stress_scale());
    const EnergyLedger before = solver->view(Need::base).energy;
    squeeze(*solver, packing.box, 0.0, settle);
    Vec2 floor = Vec2::Zero(), others = Vec2::Zero();
    double time = 0.0, virial = 0.0, moment = 0.0;
    squeeze(*solver, packing.box, 0.0, 0.2 * settle, [&](const Box& box, double dt) {
        const GrainView view = solver->view(Need::contacts);
        floor += view.wall_force[2] * dt;
        others += (view.wall_force[0] + view.wall_force[1] + view.wall_force[3]) * dt;
        virial += love_weber_stress(view)(1, 1) * box.area() * dt;
        for (std::size_t g = 0; g < view.size(); ++g)
            moment -= view.mass[g] * view.gravity.y() * (view.centroid[g].y() - box.position[2]) * dt;
        time += dt;
    });
    const GrainView view = solver->view(Need::contacts);
    const double weight = weight_of(view), band = GetParam().weight;
    RecordProperty("weight", fmt::format("{:.1e}", -floor.y() / time / weight - 1.0));
    RecordProperty("virial", fmt::format("{:.1e}", virial / moment - 1.0));
    RecordProperty("unbalanced", fmt::format("{:.1e}", unbalanced_force(view)));
    EXPECT_NEAR(-floor.y() / time, weight, band * weight);
    EXPECT_LE(others.norm() / time, band * weight);
    // Of forces on grains at rest the first moment is zero: contacts take up what weights do.
    EXPECT_NEAR(virial, moment, band * moment);
    if (GetParam().trembling < 1.0) {
        EXPECT_LE(unbalanced_force(view), GetParam().trembling);
        EXPECT_NEAR(wall_stress(view.wall_force, view.box).y(), 0.5 * weight / view.box.width(),
                    GetParam().trembling * weight / view.box.width());
    }

    const EnergyLedger after = view.energy;
    ASSERT_GT(after.external_work, 0.0) << "it has sunk";
    const double residual = after.external_work + before.kinetic + before.elastic -
                            (after.kinetic + after.elastic + after.dissipated());
    RecordProperty("residual", fmt::format("{:.1e}", residual / after.external_work));
    EXPECT_LE(std::abs(residual), GetParam().ledger * after.external_work);
}

TEST_P(Gravity, ARestartedFallHasTheSameBits) {
    const Packing packing = column();
    const auto run = [&](Solver& solver) {
        const double dt = 0.5 * solver.stable_time_step();
        for (int k = 0; k < 40; ++k) solver.advance({packing.box, {}}, dt);
        return packing.box;
    };
    expect_restart_keeps_bits(
        [&] {
            return solver_for(packing, {0.0, -1e-3});
        },
        run, [&](Solver& solver, const Box&) { run(solver); },
        [](Solver& straight, Solver& restarted) {
            EXPECT_EQ(straight.view(Need::base).energy.external_work,
                      restarted.view(Need::base).energy.external_work);
        });
}

TEST_P(Gravity, IsRefusedInAPeriodicCell) {
    Packing packing = apart();
    packing.box.periodic = true;
    EXPECT_THROW(solver_for(packing, {0.0, -1.0}), InputError);
}

TEST(QuasiStaticGravity, PutsAColumnAtRest) {
    Scenario scenario = scenario_of("sdem", "[sdem]\ndriver = \"quasi_static\"\n");
    scenario.box.gravity = {0.0, -2e-3};
    const Packing packing = column();
    const auto solver = find_method("sdem").make(scenario, packing);
    solver->advance({packing.box, {}}, 1.0);
    const GrainView view = solver->view(Need::contacts);
    // The default tolerance is a thousandth of the mean contact force.
    EXPECT_NEAR(-view.wall_force[2].y(), weight_of(view), 3e-3 * weight_of(view));
    EXPECT_LE(unbalanced_force(view), 1e-3);
    const EnergyLedger e = view.energy;
    ASSERT_GT(e.external_work, 0.0);
    EXPECT_GT(e.damping, 0.0) << "half of the work of weights that are put on all at once";
    EXPECT_NEAR(e.external_work, e.elastic + e.damping, 1e-9 * e.external_work);
}

}  // namespace
}  // namespace softgrain
