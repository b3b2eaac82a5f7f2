// Servo-control against rows of discs whose stiffness and inertia are known.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "common/observables/observable.hpp"
#include "common/time_loop.hpp"
#include "tests/support/affine_solver.hpp"
#include "tests/support/chain_solver.hpp"
#include "tests/support/step_response.hpp"

namespace softgrain {
namespace {

using testing::AffineSolver;
using testing::ChainSolver;
using testing::StepResponse;

const std::atomic<int> never{0};
constexpr int discs = 20;

LoadingStage to_pressure(double pressure, double strain_rate) {
    LoadingStage stage;
    stage.kind = LoadingKind::stress;
    stage.stress_xx = stage.stress_yy = pressure;
    stage.strain_rate = strain_rate;
    return stage;
}

/// A stage that stays on the stress for a while, for no stress is ever within so narrow a band.
LoadingStage staying(LoadingStage stage, double duration) {
    stage.tolerance = 1e-12;
    stage.duration = duration;
    return stage;
}

Scenario with_stages(std::vector<LoadingStage> stages, double strain_interval = 1e-3) {
    Scenario s;
    s.loading = std::move(stages);
    s.sampling.strain_interval = strain_interval;
    return s;
}

/// The smoothed stress on the walls in each stage.
std::vector<StepResponse> respond(const ChainSolver::Law& law, const Scenario& scenario,
                                  RunState* end = nullptr, std::vector<StepResponse>* inside = nullptr) {
    ChainSolver solver(discs, law);
    TimeLoop run(scenario, ChainSolver::packing(discs, law), solver, {});
    std::vector<StepResponse> all;
    double from = 0.0;
    for (const LoadingStage& stage : scenario.loading) {
        all.emplace_back(from, *stage.stress_xx);
        if (inside != nullptr) inside->emplace_back(from, *stage.stress_xx);
        from = *stage.stress_xx;
    }
    run.go(never, [&] {
        const auto stage = static_cast<std::size_t>(run.state().stage);
        all[stage].add(run.state().time, run.state().servo.stress[0]);
        if (inside != nullptr) (*inside)[stage].add(run.state().time, solver.middle_stress());
    });
    if (end != nullptr) *end = run.state();
    return all;
}

double speed_of(double stiffness) {
    return std::sqrt(stiffness);
}

TEST(Servo, ComesToItsStressWhateverTheStiffness) {
    for (const double stiffness : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1000.0}) {
        const ChainSolver::Law law{.stiffness = stiffness};  // it says 1
        const double wave = discs / speed_of(stiffness);
        std::vector<StepResponse> inside;
        RunState end;
        const auto up = respond(
            law,
            with_stages({staying(to_pressure(0.01 * stiffness, 1e-3 * speed_of(stiffness)), 150.0 * wave)}),
            &end, &inside);
        EXPECT_LE(up[0].overshoot(), 0.02) << stiffness;
        EXPECT_LE(inside[0].overshoot(), 0.02) << stiffness;
        EXPECT_EQ(up[0].crossings(), 0) << stiffness;
        EXPECT_LE(std::abs(up[0].last_error()), 2e-3) << stiffness;
        // Strain 0.01 at the rate allowed takes half a wave's time; what is longer is caution until the
        // stiffness is known.
        EXPECT_LE(up[0].settling_time(), (stiffness > 0.05 && stiffness < 20.0 ? 30.0 : 100.0) * wave)
            << stiffness;
        EXPECT_NEAR(end.servo.stiffness, stiffness * discs / discs, 0.25 * stiffness);
    }
}

TEST(Servo, ClosesGapsFirst) {
    for (const double stiffness : {0.03, 0.1, 1.0, 10.0}) {
        const ChainSolver::Law law{.stiffness = stiffness, .gap = 0.01};
        const double wave = discs / speed_of(stiffness);
        std::vector<StepResponse> inside;
        const auto up = respond(
            law,
            with_stages({staying(to_pressure(0.01 * stiffness, 1e-3 * speed_of(stiffness)), 150.0 * wave)}),
            nullptr, &inside);
        EXPECT_LE(up[0].overshoot(), 0.05) << stiffness;
        EXPECT_LE(inside[0].overshoot(), 0.05) << stiffness;
        EXPECT_LE(up[0].crossings(), 1) << stiffness;
        EXPECT_LE(up[0].settling_time(), 60.0 * wave) << stiffness;
    }
}

/// Overlap^1.5: thirty times softer at the start than at the end.
TEST(Servo, FollowsAPackingThatStiffensUpAndDown) {
    const ChainSolver::Law law{.stiffness = 1.0, .power = 1.5};
    const ChainSolver measured(discs, law);
    const double rate = 1e-3, wave = measured.response_time(1e-3);
    std::vector<StepResponse> inside;
    const auto steps = respond(law,
                               with_stages({staying(to_pressure(1e-4, rate), 100.0 * wave),
                                            staying(to_pressure(1e-2, rate), 100.0 * wave),
                                            staying(to_pressure(2e-4, rate), 100.0 * wave)}),
                               nullptr, &inside);
    for (std::size_t k = 0; k < steps.size(); ++k) {
        EXPECT_LE(steps[k].overshoot(), 0.05) << "stage " << k;
        EXPECT_LE(inside[k].overshoot(), 0.05) << "stage " << k;
        EXPECT_LE(steps[k].crossings(), 1) << "stage " << k;
        EXPECT_LE(steps[k].settling_time(), 80.0 * wave) << "stage " << k;
    }
}

/// Contact dynamics: forces on walls that go up and down by a third from step to step.
TEST(Servo, IsNotShakenByTremblingForces) {
    const ChainSolver::Law law{.tremble = 0.33};
    std::vector<StepResponse> inside;
    const auto up =
        respond(law, with_stages({staying(to_pressure(0.01, 1e-3), 100.0 * discs)}), nullptr, &inside);
    EXPECT_LE(inside[0].overshoot(), 0.05);
    EXPECT_LE(std::abs(inside[0].last_error()), 0.03);
    EXPECT_EQ(inside[0].crossings(0.05), 0);
}

/// Without the offset the lateral stress would lie K tau times the axial rate beyond its target: 0.14 of it.
TEST(Servo, HoldsAgainstASteadyDisturbance) {
    Packing packing;
    packing.box.position = {0.0, 20.0, 0.0, 20.0};
    for (int k = 0; k < 400; ++k) {
        packing.center.emplace_back(k % 20 + 0.5, k / 20 + 0.5);
        packing.radius.push_back(0.5);
    }
    for (const bool periodic : {false, true}) {
        packing.box.periodic = periodic;
        AffineSolver solver(packing);
        solver.time_step = 0.1;
        LoadingStage biaxial;
        biaxial.kind = LoadingKind::biaxial;
        biaxial.lateral_stress = 0.02;
        biaxial.strain_rate = 1e-4;
        biaxial.until_strain = 0.1;
        const Scenario scenario = with_stages({to_pressure(0.02, 1e-4), biaxial}, 1e-3);
        TimeLoop run(scenario, packing, solver, {});
        double most = 0.0, late = 0.0;
        run.go(never, [&] {
            const RunState& now = run.state();
            if (now.stage == 0) return;
            const double error = std::abs(now.servo.stress[0] / 0.02 - 1.0);
            most = std::max(most, error);
            if (1.0 - now.box.height() / 20.0 > 0.05) late = std::max(late, error);
        });
        EXPECT_LE(most, 0.14) << "at the start of the disturbance";
        EXPECT_LE(late, 0.01);
        // The area stays: that is what this packing answers to.
        EXPECT_NEAR(run.state().box.area(), 400.0 / 1.02, 0.5);
        EXPECT_NEAR(run.state().box.height(), 18.0, 1e-9);
    }
}

TEST(Servo, KeepsItsBitsOverARestart) {
    const ChainSolver::Law law{.gap = 1e-3, .tremble = 0.1};
    const Packing packing = ChainSolver::packing(discs, law);
    LoadingStage biaxial;
    biaxial.kind = LoadingKind::biaxial;
    biaxial.lateral_stress = 0.01;
    biaxial.inertial_number = 1e-2;
    biaxial.until_strain = 0.03;
    const Scenario scenario = with_stages({to_pressure(0.01, 1e-3), to_pressure(0.005, 1e-3), biaxial}, 5e-3);
    ChainSolver straight(discs, law);
    TimeLoop whole(scenario, packing, straight, {});
    whole.go(never);
    ASSERT_EQ(whole.state().ended, "loading done");
    const long long steps = whole.state().step;
    for (const double part : {0.01, 0.3, 0.5, 0.8}) {
        Checkpoint loop, grains;
        std::atomic<int> stop{0};
        ChainSolver first(discs, law);
        TimeLoop begun(scenario, packing, first, {});
        begun.go(stop, [&] {
            stop = begun.state().step >= static_cast<long long>(part * static_cast<double>(steps));
        });
        begun.state().save(loop);
        first.save(grains);
        ChainSolver second(discs, law);
        second.load(grains);
        RunState state;
        state.load(loop);
        TimeLoop rest(scenario, packing, second, {});
        rest.resume(state);
        rest.go(never);
        Checkpoint one, other;
        whole.state().save(one);
        rest.state().save(other);
        for (const auto& [name, values] : one.numbers)
            EXPECT_EQ(
                std::memcmp(values.data(), other.numbers.at(name).data(), values.size() * sizeof(double)), 0)
                << name << ", stopped after " << part;
    }
}

/// A wave has to cross a box with walls; a cell strains all its grains at once, however many they are.
TEST(ServoLaw, AnswersOfACellDoNotDependOnItsSize) {
    const auto rate = [](double side, bool periodic) {
        Box box;
        box.position = {0.0, side, 0.0, side};
        box.periodic = periodic;
        const double target = 1e-3, diameter = 1.0;
        const Servo servo({target, target}, box, 1.0, diameter, false);
        ServoState state = servo.begin({}, box, {target, target}, 1.0);
        const std::array<double, 2> disturbed{0.5 * target, target};
        for (int k = 0; k < 100; ++k) servo.update(state, box, disturbed, 1.0, 1e-3);
        return state.rate[0];
    };
    EXPECT_GT(rate(20.0, true), 0.0);
    EXPECT_DOUBLE_EQ(rate(200.0, true), rate(20.0, true));
    EXPECT_GT(rate(20.0, true), 4.0 * rate(20.0, false));  // 4 diameters against 20
    EXPECT_GT(rate(20.0, false), 5.0 * rate(200.0, false));
}

}  // namespace
}  // namespace softgrain
