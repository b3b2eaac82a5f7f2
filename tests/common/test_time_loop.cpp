#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/time_loop.hpp"
#include "tests/support/affine_solver.hpp"

namespace softgrain {
namespace {

using testing::AffineSolver;

const std::atomic<int> never{0};

Packing square_of_four() {
    Packing p;
    p.box.position = {0.0, 1.0, 0.0, 2.0};
    p.center = {{0.25, 0.5}, {0.75, 0.5}, {0.25, 1.5}, {0.75, 1.5}};
    p.radius = {0.2, 0.2, 0.2, 0.2};
    return p;
}

Scenario with_stages(std::vector<LoadingStage> stages) {
    Scenario s;
    s.loading = std::move(stages);
    s.sampling.strain_interval = 0.02;
    s.sampling.frame_every = 2;
    return s;
}

LoadingStage isotropic(double until_strain) {
    LoadingStage stage;
    stage.until_strain = until_strain;
    stage.strain_rate = 0.1;
    return stage;
}

double value(const RunState& state, std::size_t row, std::string_view column) {
    return state.history.at(row).at(observable_index(column));
}

/// The end of the whole loading.
RunState end_of(const Scenario& scenario, const Packing& packing, AffineSolver& solver) {
    TimeLoop run(scenario, packing, solver, {});
    run.go(never);
    return run.state();
}
RunState end_of(const Scenario& scenario, const Packing& packing) {
    AffineSolver solver(packing);
    return end_of(scenario, packing, solver);
}

TEST(TimeLoop, SamplesAtEqualStrainWhateverTheTimeStep) {
    for (const double dt : {0.01, 0.0037}) {
        const Packing packing = square_of_four();
        const Scenario scenario = with_stages({isotropic(0.1)});
        AffineSolver solver(packing);
        solver.time_step = dt;
        const RunState end = end_of(scenario, packing, solver);
        ASSERT_EQ(end.history.size(), 6U);
        for (std::size_t k = 0; k < 6; ++k)
            EXPECT_NEAR(value(end, k, "axial_strain"), 0.02 * static_cast<double>(k), 1e-11);
        EXPECT_EQ(end.ended, "loading done");
        EXPECT_NEAR(end.box.width(), 0.9, 1e-11);
        EXPECT_NEAR(end.box.height(), 1.8, 1e-11);
        EXPECT_NEAR(end.box.position[0], 0.05, 1e-11) << "walls close from both sides";
        EXPECT_NEAR(end.time, 1.0, 1e-9);
    }
}

TEST(TimeLoop, WallStressIsTheMeanOverTheWindowBeforeTheSample) {
    const Packing packing = square_of_four();
    Scenario scenario = with_stages({isotropic(0.1)});
    scenario.sampling.average_window = 0.5;
    AffineSolver solver(packing);
    solver.time_step = 1e-4;
    const RunState end = end_of(scenario, packing, solver);
    // Force on a side wall p h with p = 1/(1-e)^2 - 1, h = 2 (1-e); its mean over e from 0.09 to 0.10, over h
    // at the end.
    const double mean = (std::log(0.91 / 0.90) - 0.5 * (0.91 * 0.91 - 0.90 * 0.90)) / 0.01;
    EXPECT_NEAR(value(end, 5, "stress_xx"), mean / 0.9, 1e-4) << "the time step leaves 1e-5";
}

TEST(TimeLoop, OedometricMovesOneWallOnly) {
    const Packing packing = square_of_four();
    for (int wall = 0; wall < 4; ++wall) {
        LoadingStage stage = isotropic(0.1);
        stage.kind = LoadingKind::oedometric;
        stage.wall = static_cast<Wall>(wall);
        const Scenario scenario = with_stages({stage});
        const RunState end = end_of(scenario, packing);
        for (int other = 0; other < 4; ++other) {
            const double moved = std::abs(end.box.position[static_cast<std::size_t>(other)] -
                                          packing.box.position[static_cast<std::size_t>(other)]);
            EXPECT_NEAR(moved, other == wall ? 0.1 * (wall < 2 ? 1.0 : 2.0) : 0.0, 1e-11);
        }
    }
}

TEST(TimeLoop, EndsAtThePackingFractionAsked) {
    const Packing packing = square_of_four();
    LoadingStage stage;
    stage.strain_rate = 0.1;
    stage.until_packing_fraction_undeformed = 0.3;
    for (const LoadingKind kind : {LoadingKind::isotropic, LoadingKind::oedometric}) {
        stage.kind = kind;
        const Scenario scenario = with_stages({stage});
        const RunState end = end_of(scenario, packing);
        EXPECT_NEAR(end.history.back()[observable_index("packing_fraction_undeformed")], 0.3, 1e-10);
    }
    stage.until_packing_fraction_undeformed.reset();
    stage.until_packing_fraction = 0.3;
    const Scenario scenario = with_stages({stage});
    const RunState end = end_of(scenario, packing);
    const double phi = end.history.back()[observable_index("packing_fraction")];
    EXPECT_GE(phi, 0.3);
    EXPECT_LT(phi, 0.3 * (1.0 + 2.5 * 0.005))
        << "seen at the next check, a quarter of a sample later at most";
}

TEST(TimeLoop, EndsAtTheStressAsked) {
    const Packing packing = square_of_four();
    LoadingStage stage;
    stage.strain_rate = 0.1;
    stage.until_stress = 0.2;
    const Scenario scenario = with_stages({stage});
    const RunState end = end_of(scenario, packing);
    const double stress = end.history.back()[observable_index("mean_stress")];
    EXPECT_GE(stress, 0.2);
    EXPECT_LT(stress, 0.23);
}

TEST(TimeLoop, StagesFollowOneAnother) {
    const Packing packing = square_of_four();
    LoadingStage hold;
    hold.kind = LoadingKind::hold;
    hold.duration = 0.5;
    LoadingStage more = isotropic(0.08);
    more.kind = LoadingKind::oedometric;
    more.wall = Wall::top;
    const Scenario scenario = with_stages({isotropic(0.04), hold, more});
    const RunState end = end_of(scenario, packing);
    EXPECT_NEAR(end.time, 0.4 + 0.5 + 0.4, 1e-9);
    EXPECT_NEAR(end.box.height(), 2.0 * 0.92, 1e-11);
    EXPECT_NEAR(end.box.width(), 0.96, 1e-11);
    EXPECT_EQ(end.history.size(), 1U + 2U + 10U + 2U);
}

Packing cell_of_four() {
    Packing p = square_of_four();
    p.box.periodic = true;
    return p;
}

TEST(TimeLoop, ACellShrinksAsABoxDoesAndTellsItsStress) {
    LoadingStage side = isotropic(0.1);
    side.kind = LoadingKind::oedometric;
    side.wall = Wall::top;
    for (const LoadingStage& stage : {isotropic(0.1), side}) {
        const Scenario scenario = with_stages({stage});
        const RunState between_walls = end_of(scenario, square_of_four()),
                       in_cell = end_of(scenario, cell_of_four());
        ASSERT_EQ(in_cell.history.size(), between_walls.history.size());
        for (std::size_t k = 0; k < in_cell.history.size(); ++k)
            for (const char* column : {"axial_strain", "box_width", "box_height", "stress_xx", "stress_yy",
                                       "mean_stress", "deviatoric_stress"})
                // The affine grains push alike on walls and cell; a mean of forces is not one of stresses.
                EXPECT_NEAR(value(in_cell, k, column), value(between_walls, k, column), 2e-3)
                    << column << " of sample " << k;
        EXPECT_EQ(in_cell.box.tilt, 0.0);
    }
}

TEST(TimeLoop, ShearKeepsTheAreaAndSamplesAtEqualShearStrain) {
    LoadingStage shear;
    shear.kind = LoadingKind::shear;
    shear.until_shear = 1.1;  // more than the width: the loop's tilt is not reduced
    shear.strain_rate = 0.3;
    LoadingStage back = shear;
    back.until_shear = -0.1;
    back.reverse = true;
    Scenario scenario = with_stages({shear, back});
    scenario.sampling.strain_interval = 0.1;
    const RunState state = end_of(scenario, cell_of_four());
    ASSERT_EQ(state.history.size(), 1U + 11U + 12U);
    for (std::size_t k = 0; k < state.history.size(); ++k) {
        const double n = static_cast<double>(k);
        const double expected = k <= 11 ? 0.1 * n : 1.1 - 0.1 * (n - 11.0);
        EXPECT_NEAR(value(state, k, "shear_strain"), expected, 1e-11);
        EXPECT_EQ(value(state, k, "box_width"), 1.0);
        EXPECT_EQ(value(state, k, "box_height"), 2.0);
        EXPECT_EQ(value(state, k, "stress_yy"), 0.0);
    }
    EXPECT_NEAR(state.time, 1.1 / 0.3 + 1.2 / 0.3, 1e-9);
    // Mean over the last quarter of the sample interval before 1.1.
    EXPECT_NEAR(value(state, 11, "stress_xy"), -(1.1 - 0.5 * 0.025), 3e-3) << "a step is 3e-3";
}

TEST(TimeLoop, AVelocityGradientIsFollowedExactlyWhateverTheTimeStep) {
    LoadingStage stage;
    stage.kind = LoadingKind::gradient;
    stage.gradient_xx = -0.2;
    stage.gradient_xy = 0.5;
    stage.gradient_yy = 0.1;
    stage.duration = 1.5;
    Packing packing = cell_of_four();
    packing.box.tilt = 0.3;
    for (const double dt : {0.05, 0.013}) {
        const Scenario scenario = with_stages({stage});
        AffineSolver solver(packing);
        solver.time_step = dt;
        const RunState end = end_of(scenario, packing, solver);
        const Box& box = end.box;
        const double t = 1.5, xx = std::exp(-0.2 * t), yy = std::exp(0.1 * t);
        EXPECT_NEAR(box.width(), 1.0 * xx, 1e-12);
        EXPECT_NEAR(box.height(), 2.0 * yy, 1e-12);
        EXPECT_NEAR(box.tilt, 0.3 * xx + 2.0 * 0.5 * (yy - xx) / 0.3, 1e-12);
        EXPECT_NEAR(0.5 * (box.position[0] + box.position[1]), 0.5, 1e-12) << "the middle stays";
        // Samples every 0.02 of the largest rate, 0.5: 37 whole intervals of 0.04 s and the end.
        EXPECT_EQ(end.history.size(), 1U + 37U + 1U);
        EXPECT_NEAR(end.time, t, 1e-9);
    }
}

TEST(TimeLoop, EqualGradientsStretchWithoutAnIndeterminateForm) {
    LoadingStage stage;
    stage.kind = LoadingKind::gradient;
    stage.gradient_xx = stage.gradient_yy = -0.2;
    stage.gradient_xy = 0.5;
    stage.duration = 1.0;
    const Scenario scenario = with_stages({stage});
    const RunState end = end_of(scenario, cell_of_four());
    EXPECT_NEAR(end.box.tilt, 2.0 * 0.5 * std::exp(-0.2), 1e-12);
}

TEST(TimeLoop, ReverseReachesItsEndsFromAbove) {
    LoadingStage back = isotropic(-0.02);
    back.reverse = true;
    const Scenario loop = with_stages({isotropic(0.06), back});
    const RunState done = end_of(loop, square_of_four());
    EXPECT_NEAR(done.box.width(), 1.02, 1e-11);
    EXPECT_NEAR(done.box.height(), 2.04, 1e-11);
    EXPECT_EQ(done.history.size(), 1U + 3U + 4U);
    EXPECT_NEAR(value(done, 4, "axial_strain"), 0.04, 1e-11);

    for (int end = 0; end < 3; ++end) {
        LoadingStage unload = back;
        unload.until_strain.reset();
        if (end == 0) unload.until_packing_fraction_undeformed = 0.27;
        if (end == 1) unload.until_packing_fraction = 0.27;
        if (end == 2) unload.until_stress = 0.05;
        if (end == 0) unload.kind = LoadingKind::oedometric;
        const Scenario scenario = with_stages({isotropic(0.06), unload});
        AffineSolver grains(square_of_four());
        TimeLoop partly(scenario, square_of_four(), grains, {});
        partly.go(never);
        const std::size_t last = partly.state().history.size() - 1;
        const double phi = value(partly.state(), last, "packing_fraction");
        const double stress = value(partly.state(), last, "mean_stress");
        const double late = 2.5 * 0.02 / 8.0;  // what the grains decide is seen at the next check
        EXPECT_NEAR(end == 2 ? stress : phi, end == 2 ? 0.05 : 0.27, end == 0 ? 1e-10 : late);
        EXPECT_GT(partly.state().box.width() * partly.state().box.height(), 0.94 * 0.94 * 2.0);
        EXPECT_EQ(partly.loading_done(), 1.0);
    }
}

TEST(TimeLoop, AStageThatWouldHaveToGoBackIsAnError) {
    LoadingStage until_stress = isotropic(0.5);
    until_stress.until_strain.reset();
    until_stress.until_stress = 0.2;
    const Scenario scenario = with_stages({until_stress, isotropic(0.01)});
    AffineSolver solver(square_of_four());
    TimeLoop run(scenario, square_of_four(), solver, {});
    try {
        run.go(never);
        FAIL() << "the strain was 0.09 already";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("loading.1.until_strain = 0.01 is below the 0.0"), std::string::npos) << text;
        EXPECT_NE(text.find("set reverse = true"), std::string::npos) << text;
    }
}

TEST(TimeLoop, ClassesCountForTheMeanDensity) {
    const Packing plain = square_of_four();
    Packing mixed = plain;
    mixed.grain_class = {0, 1, 1, 1};
    LoadingStage stage = isotropic(0.1);
    stage.strain_rate.reset();
    stage.inertial_number = 0.01;
    Scenario dense = with_stages({stage}), classes = dense;
    dense.material.density = 4.0;  // mean of 1 and three times 5
    classes.classes.resize(2);
    classes.classes[1].material.density = 5.0;
    const double time = end_of(dense, plain).time;
    EXPECT_NEAR(end_of(classes, mixed).time, time, 1e-12 * time);
}

TEST(TimeLoop, InertialNumberSetsTheRate) {
    const Packing packing = square_of_four();
    LoadingStage stage;
    stage.until_strain = 0.1;
    stage.inertial_number = 0.01;
    const Scenario scenario = with_stages({stage});
    const RunState end = end_of(scenario, packing);
    EXPECT_NEAR(value(end, 5, "inertial_number"), 0.01, 3e-4)
        << "the pressure of the last check lags a little";
}

TEST(TimeLoop, LeavingTheValidityEndsInGoodOrder) {
    const Packing packing = square_of_four();
    const Scenario scenario = with_stages({isotropic(0.1)});
    AffineSolver solver(packing);
    solver.invalid_below = 0.95;
    const RunState end = end_of(scenario, packing, solver);
    EXPECT_EQ(end.ended, "left its range of validity: the box is too narrow");
    EXPECT_LT(end.box.width(), 0.95);
    EXPECT_GT(end.box.width(), 0.94);
    EXPECT_NEAR(value(end, end.history.size() - 1, "box_width"), end.box.width(), 1e-15);
}

class CountingObserver final : public Observer {
  public:
    Need need(const Sample&) const override { return Need::base; }
    void observe(const GrainView& view, const Sample& sample) override {
        for (const Vec2& v : view.velocity) finite = finite && v.allFinite();
        samples = sample.index + 1;
        if (sample.is_frame) frames.push_back(view.time);
    }
    std::vector<std::string> resume(std::span<const double> times) override {
        frames.assign(times.begin(), times.end());
        return {};
    }
    bool finite = true;
    int samples = 0;
    std::vector<double> frames;
};

TEST(TimeLoop, NothingNotFiniteReachesAnObserver) {
    const Packing packing = square_of_four();
    const Scenario scenario = with_stages({isotropic(0.1)});
    AffineSolver solver(packing);
    solver.poison_at = 0.5;
    CountingObserver observer;
    TimeLoop run(scenario, packing, solver, {&observer});
    EXPECT_THROW(run.go(never), DivergedError);
    EXPECT_TRUE(observer.finite);
    EXPECT_EQ(observer.samples, 3);
}

struct Seen {
    RunState end;
    std::vector<double> frames;
};

Seen run_straight(const Scenario& scenario, const Packing& packing) {
    AffineSolver solver(packing);
    CountingObserver observer;
    TimeLoop run(scenario, packing, solver, {&observer});
    run.go(never);
    return {run.state(), observer.frames};
}

/// Stopped after so many steps; saved, loaded and run to the end.
Seen run_in_two(const Scenario& scenario, const Packing& packing, int stop_after) {
    Checkpoint loop, state;
    {
        std::atomic<int> stop{0};
        AffineSolver solver(packing);
        CountingObserver observer;
        TimeLoop run(scenario, packing, solver, {&observer});
        run.go(stop, [&] { stop = solver.steps >= stop_after ? 15 : 0; });
        EXPECT_FALSE(run.finished());
        run.state().save(loop);
        solver.save(state);
    }
    AffineSolver solver(packing);
    solver.load(state);
    RunState restored;
    restored.load(loop);
    CountingObserver observer;
    TimeLoop run(scenario, packing, solver, {&observer});
    run.resume(restored);
    run.go(never);
    return {run.state(), observer.frames};
}

/// Bit by bit: columns that a method does not give are nan.
bool same_rows(const std::vector<std::vector<double>>& a, const std::vector<std::vector<double>>& b) {
    return std::ranges::equal(a, b, [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::memcmp(x.data(), y.data(), x.size() * sizeof(double)) == 0;
    });
}

TEST(TimeLoop, ACheckpointWithOtherHistoryColumnsIsRefused) {
    Checkpoint saved;
    RunState().save(saved);
    RunState restored;
    EXPECT_NO_THROW(restored.load(saved));
    saved.integers.at("history_columns").front() += 1;
    EXPECT_THROW(restored.load(saved), InputError);
}

TEST(TimeLoop, AShearedCellResumesWithTheSameBits) {
    LoadingStage shear;
    shear.kind = LoadingKind::shear;
    shear.until_shear = 0.7;
    shear.strain_rate = 0.3;
    const Scenario scenario = with_stages({isotropic(0.04), shear});
    const Seen straight = run_straight(scenario, cell_of_four());
    for (const int stop_after : {15, 57, 100}) {
        const Seen in_two = run_in_two(scenario, cell_of_four(), stop_after);
        EXPECT_TRUE(same_rows(in_two.end.history, straight.end.history)) << "stopped after " << stop_after;
        EXPECT_EQ(in_two.end.box.tilt, straight.end.box.tilt);
    }
}

TEST(TimeLoop, StoppedAnywhereAndResumedGivesTheSameBits) {
    LoadingStage hold;
    hold.kind = LoadingKind::hold;
    hold.duration = 0.2;
    LoadingStage fast = isotropic(0.1);
    fast.strain_rate.reset();
    fast.inertial_number = 0.02;
    const Scenario scenario = with_stages({isotropic(0.04), hold, fast});
    const Seen straight = run_straight(scenario, square_of_four());
    for (const int stop_after : {1, 7, 41, 53, 70, 90}) {
        const Seen in_two = run_in_two(scenario, square_of_four(), stop_after);
        EXPECT_TRUE(same_rows(in_two.end.history, straight.end.history)) << "stopped after " << stop_after;
        EXPECT_EQ(in_two.frames, straight.frames);
        EXPECT_EQ(in_two.end.ended, straight.end.ended);
    }
}

}  // namespace
}  // namespace softgrain
