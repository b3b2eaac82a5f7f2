// Servo-control of every method: how the stress comes to its target.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>

#include "common/observables/stress.hpp"
#include "common/time_loop.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/jammed_cell.hpp"
#include "tests/support/step_response.hpp"

namespace softgrain {
namespace {

using namespace testing;

class StepResponses : public ::testing::TestWithParam<Bands> {
  protected:
    /// Up from nothing, up again and back; the stress is the mean over the time of a wave through the box.
    void step_up_and_down(const Packing& packing) const {
        const auto scale = make(GetParam(), served(GetParam(), {}), packing)->stress_scale();
        const double wave = packing.box.width() / std::sqrt(scale);
        const double pressure = GetParam().servo_pressure * scale;
        const std::array<double, 4> pressures{0.0, pressure, 2.0 * pressure, pressure};
        std::vector<LoadingStage> stages;
        std::vector<StepResponse> response;
        for (std::size_t k = 1; k < pressures.size(); ++k) {
            stages.push_back(to_pressure(pressures[k], GetParam().servo_inertial_number));
            stages.back().tolerance = 1e-12;  // stays there to the end
            stages.back().duration = GetParam().servo_waves * wave;
            for (int axis = 0; axis < 2; ++axis) response.emplace_back(pressures[k - 1], pressures[k]);
        }
        const Scenario all = served(GetParam(), stages);
        const auto solver = make(GetParam(), all, packing);
        TimeLoop run(all, packing, *solver, {});
        Vec2 impulse = Vec2::Zero();
        double since = 0.0, before = 0.0;
        int stage = 0;
        run.go(std::atomic<int>{0}, [&] {
            const RunState& now = run.state();
            if (now.stage != stage) {
                impulse.setZero();
                since = 0.0;
                stage = now.stage;
            }
            const double dt = now.time - before;
            before = now.time;
            const Mat2 cell = packing.box.periodic ? solver->cell_stress() : Mat2(Mat2::Zero());
            impulse += boundary_stress(solver->wall_force(), cell, now.box).diagonal() * dt;
            since += dt;
            if (since < wave) return;
            for (int axis = 0; axis < 2; ++axis)
                response[static_cast<std::size_t>(2 * stage + axis)].add(now.time, impulse[axis] / since);
            impulse.setZero();
            since = 0.0;
        });
        ASSERT_EQ(run.state().ended, "loading done");
        for (std::size_t k = 0; k < response.size(); ++k) {
            const std::string name = fmt::format("stage_{}_{}", k / 2, k % 2 == 0 ? "xx" : "yy");
            RecordProperty(
                name, fmt::format("overshoot {:.3f}, settled after {:.0f} waves", response[k].overshoot(),
                                  response[k].settling_time(0.05) / wave));
            EXPECT_LE(response[k].overshoot(), 0.05) << name;
            EXPECT_LE(response[k].crossings(0.05), 0) << name;
            EXPECT_LE(std::abs(response[k].last_error()), 0.02) << name;
        }
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, StepResponses, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST_P(StepResponses, StressComesToItsTargetWithoutGoingBeyond) {
    if (GetParam().servo_waves == 0.0) GTEST_SKIP() << "350 waves of resolved grains take ten minutes";
    step_up_and_down(jammed_box(20));
}

TEST_P(StepResponses, StressOfACellComesToItsTargetWithoutGoingBeyond) {
    if (GetParam().cell == 0.0) GTEST_SKIP() << "no periodic cell";
    step_up_and_down(jammed_cell(30));
}

}  // namespace
}  // namespace softgrain
