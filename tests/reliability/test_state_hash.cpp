// The number that stands for a state: it tells any bit, and does not depend on threads or restarts.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <utility>

#include "common/state_hash.hpp"
#include "common/time_loop.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain {
namespace {

using namespace testing;

TEST(StateHash, TellsAnyBitOfWhatItReads) {
    std::vector<Vec2> centroid{{0.5, 1.5}, {2.0, -3.0}}, velocity{{0.0, 0.0}, {1.0, -1.0}};
    std::vector<double> area{1.0, 2.0};
    std::vector<Mat2> stress(2, Mat2::Identity());
    std::vector<GrainContact> contacts{{0, 1, {1.0, 1.0}, {1.0, 0.0}, {-2.0, 0.0}, 0.1}};
    GrainView view;
    view.centroid = centroid;
    view.velocity = velocity;
    view.area = area;
    view.stress = stress;
    view.contacts = contacts;
    const std::uint64_t hash = state_hash(view);
    EXPECT_EQ(state_hash(view), hash);
    for (double* number :
         {&centroid[1].x(), &velocity[1].y(), &area[0], &stress[1](0, 1), &contacts[0].force.x(),
          &contacts[0].point.y(), &contacts[0].length, &view.time, &view.box.tilt, &view.box.position[2],
          &view.energy.impact, &view.wall_force[3].x()})
        for (const double changed : {std::nextafter(*number, 9.0), *number == 0.0 ? -0.0 : -*number}) {
            const double before = std::exchange(*number, changed);
            EXPECT_NE(state_hash(view), hash) << before << " became " << changed;
            *number = before;
        }
    contacts[0].j = -1;
    EXPECT_NE(state_hash(view), hash);
    contacts[0].j = 1;
    for (Vec2& v : velocity) v = -v;
    EXPECT_NE(state_hash(view), hash) << "changes of sign that cancel";
}

class StateHashes : public ::testing::TestWithParam<Bands> {
  protected:
    struct Run {
        Scenario scenario;
        Packing packing;
    };
    Run run() const {
        const bool grains_have_parts = GetParam().method == "bpm" || GetParam().method == "mpm";
        Scenario scenario = scenario_of(GetParam().method);
        const Packing packing = square_lattice(grains_have_parts ? 3 : 30);
        const auto solver = make(GetParam(), scenario, packing);
        LoadingStage& stage = scenario.loading.front();
        stage.until_strain = 0.004;
        stage.strain_rate = 0.004 / (24.0 * solver->stable_time_step());
        scenario.sampling.strain_interval = 0.001;
        return {scenario, packing};
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, StateHashes, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST_P(StateHashes, AreTheSameOverThreadsAndRestarts) {
    const auto [scenario, packing] = run();
    const ThreadsInAnyCase wanted;
    const int before = omp_get_max_threads();
    std::vector<std::vector<std::int64_t>> hashes;
    Checkpoint straight;
    for (const int threads : {1, 2, 3, 8}) {
        omp_set_num_threads(threads);
        const auto solver = make(GetParam(), scenario, packing);
        TimeLoop loop(scenario, packing, *solver, {});
        loop.go(std::atomic<int>{0});
        hashes.push_back(loop.state().state_hashes);
        straight = {};
        loop.state().save(straight);
        EXPECT_EQ(hashes.back().size(), loop.state().history.size());
        EXPECT_EQ(hashes.back(), hashes.front()) << threads << " threads";
    }
    ASSERT_GE(hashes.front().size(), 5U);
    for (std::size_t k = 1; k < hashes.front().size(); ++k)
        EXPECT_NE(hashes.front()[k], hashes.front()[k - 1]);

    // Stopped after every step, and gone on with on another number of threads each time.
    auto solver = make(GetParam(), scenario, packing);
    RunState state;
    Checkpoint of_loop;
    bool begun = false;
    for (int part = 0; state.ended.empty(); ++part) {
        TimeLoop loop(scenario, packing, *solver, {});
        if (begun) loop.resume(state);
        std::atomic<int> stop{0};
        loop.go(stop, [&] { stop = 1; });
        Checkpoint of_solver;
        of_loop = {};
        loop.state().save(of_loop);
        solver->save(of_solver);
        omp_set_num_threads(1 + part % 3);
        solver = make(GetParam(), scenario, packing);
        solver->load(of_solver);
        state.load(of_loop);
        begun = true;
    }
    omp_set_num_threads(before);
    EXPECT_EQ(state.state_hashes, hashes.front());
    const std::vector<double>&a = straight.numbers.at("history"), &b = of_loop.numbers.at("history");
    ASSERT_EQ(a.size(), b.size());
    EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(double)), 0) << "rows of the history";
}

}  // namespace
}  // namespace softgrain
