// What each kind of stage does with the box, and how it ends, on grains that follow it affinely.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/time_loop.hpp"
#include "tests/support/affine_solver.hpp"
#include "tests/support/chain_solver.hpp"

namespace softgrain {
namespace {

using testing::AffineSolver;
using testing::ChainSolver;

const std::atomic<int> never{0};

/// p = 1 (A0 / A - 1) in a box of 10 x 10, a cell also a shear stress of -1 times its shear strain.
Packing hundred(bool periodic = false) {
    Packing p;
    p.box.position = {0.0, 10.0, 0.0, 10.0};
    p.box.periodic = periodic;
    for (int k = 0; k < 100; ++k) {
        p.center.emplace_back(k % 10 + 0.5, k / 10 + 0.5);
        p.radius.push_back(0.5);
    }
    return p;
}

Scenario with_stages(std::vector<LoadingStage> stages) {
    Scenario s;
    s.loading = std::move(stages);
    s.sampling.strain_interval = 1e-3;
    return s;
}

LoadingStage of_kind(LoadingKind kind, double strain_rate = 1e-3) {
    LoadingStage stage;
    stage.kind = kind;
    stage.strain_rate = strain_rate;
    return stage;
}

RunState end_of(const Scenario& scenario, const Packing& packing) {
    AffineSolver solver(packing);
    solver.time_step = 0.05;
    TimeLoop run(scenario, packing, solver, {});
    run.go(never);
    return run.state();
}

double value(const RunState& state, std::size_t row, std::string_view column) {
    return state.history.at(row).at(observable_index(column));
}
double last(const RunState& state, std::string_view column) {
    return value(state, state.history.size() - 1, column);
}

TEST(Loading, UniaxialMovesBothWallsOfOneAxis) {
    for (const int axis : {0, 1}) {
        LoadingStage stage = of_kind(LoadingKind::uniaxial);
        stage.axis = axis;
        stage.until_strain = 0.01;
        const RunState end = end_of(with_stages({stage}), hundred());
        const auto a = static_cast<std::size_t>(2 * axis), b = 2 - a;
        EXPECT_NEAR(end.box.position[a], 0.05, 1e-12);
        EXPECT_NEAR(end.box.position[a + 1], 9.95, 1e-12);
        EXPECT_EQ(end.box.position[b], 0.0);
        EXPECT_EQ(end.box.position[b + 1], 10.0);
        EXPECT_NEAR(last(end, axis == 0 ? "strain_xx" : "strain_yy"), 0.01, 1e-12);
        EXPECT_EQ(last(end, axis == 0 ? "strain_yy" : "strain_xx"), 0.0);
        EXPECT_NEAR(last(end, "volumetric_strain"), 0.01, 1e-12);
        EXPECT_NEAR(last(end, "axial_strain"), 0.01, 1e-12);
        EXPECT_EQ(end.history.size(), 11U);
    }
}

TEST(Loading, StressGoesToItsTargetAndEndsThere) {
    for (const bool periodic : {false, true}) {
        LoadingStage stage = of_kind(LoadingKind::stress);
        stage.stress_xx = stage.stress_yy = 0.05;
        const RunState end = end_of(with_stages({stage}), hundred(periodic));
        EXPECT_EQ(end.ended, "loading done");
        EXPECT_NEAR(last(end, "stress_xx"), 0.05, 0.01 * 0.05);
        EXPECT_NEAR(end.box.area(), 100.0 / 1.05, 0.06);
        EXPECT_NEAR(end.box.width(), end.box.height(), 1e-9);
        // Samples at equal steps of the largest rate times time.
        const double time = value(end, 1, "time");
        EXPECT_NEAR(time, 1.0, 1e-9);
        EXPECT_NEAR(value(end, 5, "time"), 5.0 * time, 1e-9);
    }
}

TEST(Loading, AnAxisWithoutAStressStands) {
    LoadingStage stage = of_kind(LoadingKind::stress);
    stage.stress_yy = 0.05;
    const RunState end = end_of(with_stages({stage}), hundred());
    EXPECT_EQ(end.box.width(), 10.0);
    EXPECT_NEAR(last(end, "stress_yy"), 0.05, 0.01 * 0.05);
    EXPECT_NEAR(last(end, "strain_yy"), 1.0 - 1.0 / 1.05, 6e-4);
}

TEST(Loading, BiaxialEndsAtItsStressRatio) {
    // Independent rows: the axial stress rises with the axial strain alone.
    const ChainSolver::Law law{.stiffness = 1.0, .damping = 0.3};
    LoadingStage consolidate = of_kind(LoadingKind::stress);
    consolidate.stress_xx = consolidate.stress_yy = 0.01;
    LoadingStage biaxial = of_kind(LoadingKind::biaxial, 1e-5);
    biaxial.lateral_stress = 0.01;
    biaxial.until_stress_ratio = 0.25;  // (s - 0.01) / (s + 0.01): s = 0.01667
    const Scenario scenario = with_stages({consolidate, biaxial});
    ChainSolver solver(20, law);
    TimeLoop run(scenario, ChainSolver::packing(20, law), solver, {});
    run.go(never);
    const RunState& end = run.state();
    EXPECT_NEAR(last(end, "stress_xx"), 0.01, 1e-4);
    EXPECT_NEAR(last(end, "stress_yy"), 0.01 * 1.25 / 0.75, 3e-4) << "seen at the next check";
    EXPECT_GE(last(end, "deviatoric_stress") / last(end, "mean_stress"), -0.26);
    EXPECT_LE(last(end, "deviatoric_stress") / last(end, "mean_stress"), -0.25);
}

TEST(Loading, OneStressComponentEndsAStage) {
    LoadingStage up = of_kind(LoadingKind::uniaxial), down = up;
    up.until_stress_yy = 0.03;
    down.until_stress_xx = 0.01;
    down.reverse = true;
    const RunState end = end_of(with_stages({up, down}), hundred());
    EXPECT_NEAR(last(end, "stress_xx"), 0.01, 5e-4) << "seen at the next check";
    double most = 0.0;
    for (std::size_t k = 0; k < end.history.size(); ++k) most = std::max(most, value(end, k, "stress_yy"));
    EXPECT_NEAR(most, 0.03, 5e-4);
}

TEST(Loading, ShearAtConstantNormalStressKeepsItAndItsSamples) {
    LoadingStage consolidate = of_kind(LoadingKind::stress);
    consolidate.stress_xx = consolidate.stress_yy = 0.05;
    LoadingStage shear = of_kind(LoadingKind::shear);
    shear.normal_stress = 0.08;
    shear.until_shear = 0.15;
    const Scenario scenario = with_stages({consolidate, shear});
    const RunState end = end_of(scenario, hundred(true));
    EXPECT_NEAR(last(end, "shear_strain"), 0.15, 1e-9);
    EXPECT_NEAR(last(end, "stress_yy"), 0.08, 8e-4);
    EXPECT_NEAR(last(end, "box_width"), 10.0 / std::sqrt(1.05), 6e-3) << "xx stands";
    const std::size_t rows = end.history.size();
    for (std::size_t back = 2; back < 50; ++back)
        EXPECT_NEAR(value(end, rows - back, "shear_strain"), 0.15 - 1e-3 * static_cast<double>(back - 1),
                    1e-9)
            << "whatever the height does";
}

TEST(Loading, AStrainProbeGoesInItsDirection) {
    LoadingStage probe = of_kind(LoadingKind::probe);
    probe.direction = 120.0;
    probe.strain_amplitude = 0.01;
    const RunState end = end_of(with_stages({probe}), hundred());
    EXPECT_NEAR(last(end, "strain_xx"), -0.005, 1e-12);
    EXPECT_NEAR(last(end, "strain_yy"), 0.01 * std::sqrt(0.75), 1e-12);
    EXPECT_EQ(end.history.size(), 11U);
}

TEST(Loading, AStressProbeGoesStraightToItsEnd) {
    const ChainSolver::Law law{.stiffness = 1.0, .damping = 0.3};
    LoadingStage consolidate = of_kind(LoadingKind::stress);
    consolidate.stress_xx = consolidate.stress_yy = 0.01;
    consolidate.tolerance = 1e-4;
    LoadingStage probe = of_kind(LoadingKind::probe, 1e-4);
    probe.direction = -60.0;
    probe.stress_amplitude = 1e-3;
    Scenario scenario = with_stages({consolidate, probe});
    scenario.sampling.strain_interval = 1e-4;
    ChainSolver solver(20, law);
    TimeLoop run(scenario, ChainSolver::packing(20, law), solver, {});
    double aside = 0.0;
    const double x = std::cos(-M_PI / 3.0), y = std::sin(-M_PI / 3.0);
    run.go(never, [&] {
        if (run.state().stage == 0) return;
        const auto& stress = run.state().servo.stress;
        aside = std::max(aside, std::abs(-y * (stress[0] - 0.01) + x * (stress[1] - 0.01)));
    });
    EXPECT_NEAR(last(run.state(), "stress_xx"), 0.01 + 1e-3 * x, 2e-5);
    EXPECT_NEAR(last(run.state(), "stress_yy"), 0.01 + 1e-3 * y, 2e-5);
    EXPECT_LE(aside, 0.05e-3);
}

TEST(Loading, AProbeThatWouldPullIsAnError) {
    LoadingStage consolidate = of_kind(LoadingKind::stress);
    consolidate.stress_xx = consolidate.stress_yy = 0.01;
    LoadingStage probe = of_kind(LoadingKind::probe);
    probe.direction = 180.0;
    probe.stress_amplitude = 0.02;
    try {
        end_of(with_stages({consolidate, probe}), hundred());
        FAIL() << "to a stress of -0.01";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("loading.1 goes to a stress of -0.01"), std::string::npos)
            << error.what();
    }
}

TEST(Loading, CyclesComeBack) {
    LoadingStage up = of_kind(LoadingKind::uniaxial), down = up, repeat;
    up.until_strain = 0.02;
    down.until_strain = 0.01;
    down.reverse = true;
    repeat.kind = LoadingKind::repeat;
    repeat.stages = 2;
    repeat.times = 3;
    LoadingStage first = up;
    const RunState end = end_of(with_stages({first, down, up, down, repeat}), hundred());
    EXPECT_EQ(end.ended, "loading done");
    EXPECT_NEAR(end.box.height(), 9.9, 1e-9);
    EXPECT_NEAR(end.time, 20.0 + 9.0 * 10.0, 1e-6) << "2 %, then nine half cycles of 1 %";
    EXPECT_EQ(end.history.size(), 1U + 20U + 9U * 10U);
    const std::size_t stage = observable_index("stage");
    EXPECT_EQ(end.history[20][stage], 1.0);  // the last sample of a stage belongs to it
    EXPECT_EQ(end.history[21][stage], 2.0);
    EXPECT_EQ(end.history.back()[stage], 10.0);
}

TEST(Loading, TimeEndsAnyStage) {
    LoadingStage squeeze = of_kind(LoadingKind::isotropic);
    squeeze.until_strain = 0.5;
    squeeze.duration = 3.3333;
    LoadingStage stress = of_kind(LoadingKind::stress);
    stress.stress_xx = stress.stress_yy = 1.0;
    stress.duration = 2.5;
    for (const LoadingStage& stage : {squeeze, stress}) {
        const RunState end = end_of(with_stages({stage}), hundred());
        EXPECT_NEAR(end.time, *stage.duration, 1e-9);
        EXPECT_NEAR(last(end, "time"), *stage.duration, 1e-9);
    }
}

/// Two grains that push on each other; what is left over falls with time.
class SettlingGrains final : public Solver {
  public:
    explicit SettlingGrains(const Packing& packing) : grains_(packing) {}
    double stable_time_step() const override { return 0.05; }
    void advance(const WallMotion& walls, double dt) override {
        grains_.advance(walls, dt);
        time_ += dt;
    }
    GrainView view(Need need) override {
        GrainView v = grains_.view(need);
        if (wants(need, Need::contacts)) {
            ++looks;
            const Vec2 x{1.0, 0.0}, nowhere = Vec2::Zero();
            contacts_ = {{0, -1, nowhere, -x, x, 0.0},
                         {0, 1, nowhere, x, (left_over() - 1.0) * x, 0.0},
                         {1, -2, nowhere, x, -x, 0.0}};
            v.contacts = contacts_;
        }
        return v;
    }
    double left_over() const { return std::exp(-time_); }
    const std::array<Vec2, 4>& wall_force() const override { return grains_.wall_force(); }
    double stress_scale() const override { return 1.0; }
    void check_finite() const override {}
    void save(Checkpoint& to) const override { grains_.save(to); }
    void load(const Checkpoint& from) override { grains_.load(from); }
    int looks = 0;

  private:
    AffineSolver grains_;
    double time_ = 0.0;
    std::vector<GrainContact> contacts_;
};

TEST(Loading, AHoldEndsInEquilibriumAndLooksAtContactsOnlyThen) {
    LoadingStage hold;
    hold.kind = LoadingKind::hold;
    hold.duration = 10.0;
    SettlingGrains unasked(hundred());
    const Scenario long_hold = with_stages({hold});
    TimeLoop whole(long_hold, hundred(), unasked, {});
    whole.go(never);
    EXPECT_NEAR(whole.state().time, 10.0, 1e-9);
    EXPECT_EQ(unasked.looks, 11) << "at its samples only";

    Scenario often = long_hold;
    often.sampling.time_interval = 0.5;
    TimeLoop sampled(often, hundred(), unasked, {});
    sampled.go(never);
    EXPECT_EQ(sampled.state().history.size(), 21U) << "every half second";

    hold.until_unbalanced = 0.001;
    SettlingGrains grains(hundred());
    const Scenario scenario = with_stages({hold});
    TimeLoop run(scenario, hundred(), grains, {});
    run.go(never);
    // Left over 2 e^-t on 100 grains, over a mean force of nearly 1: 0.001 at t = ln 20; a check every 0.125,
    // a step 0.05.
    EXPECT_GE(run.state().time, std::log(20.0) - 0.01);
    EXPECT_LE(run.state().time, std::log(20.0) + 0.125 + 0.05);
}

}  // namespace
}  // namespace softgrain
