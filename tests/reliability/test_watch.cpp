// The watch finds a wrong force, a wrong ledger and contacts that are lost; a sound run keeps its limits.
#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/time_loop.hpp"
#include "tests/contract/scenes.hpp"

namespace softgrain {
namespace {

using namespace testing;

/// A method with something wrong: after every step its state is changed, or what it shows is.
class Spoiled final : public Solver {
  public:
    std::function<void(Checkpoint&, double dt)> state = {};
    std::function<void(GrainView&)> seen = {};

    explicit Spoiled(std::unique_ptr<Solver> sound) : sound_(std::move(sound)) {}
    double stable_time_step() const override { return sound_->stable_time_step(); }
    void advance(const WallMotion& walls, double dt) override {
        sound_->advance(walls, dt);
        if (!state) return;
        Checkpoint now;
        sound_->save(now);
        state(now, dt);
        sound_->load(now);
    }
    GrainView view(Need need) override {
        GrainView view = sound_->view(need);
        if (seen) seen(view);
        return view;
    }
    const std::array<Vec2, 4>& wall_force() const override { return sound_->wall_force(); }
    double stress_scale() const override { return sound_->stress_scale(); }
    void check_finite() const override { sound_->check_finite(); }
    void save(Checkpoint& to) const override { sound_->save(to); }
    void load(const Checkpoint& from) override { sound_->load(from); }

  private:
    std::unique_ptr<Solver> sound_;
};

class Watched : public ::testing::TestWithParam<Bands> {
  protected:
    Scenario scenario() const {
        Scenario s = scenario_of(GetParam().method);
        const double time = 0.1 * GetParam().loading_time;
        s.loading.front().until_strain = 0.1;
        s.loading.front().strain_rate = 0.1 / time;
        s.sampling.strain_interval = 0.02;
        s.watch = {false, 0.5, 0.1, 0.2, 1.0, 0.0};
        return s;
    }
    Spoiled solver(const Scenario& scenario) const { return Spoiled(make(GetParam(), scenario, packing)); }
    RunState end_of(const Scenario& scenario, Solver& solver) const {
        TimeLoop loop(scenario, packing, solver, {});
        loop.go(std::atomic<int>{0});
        return loop.state();
    }
    static std::size_t limit(std::string_view name) {
        return static_cast<std::size_t>(std::ranges::find(watch_limits, name) - watch_limits.begin());
    }
    /// Accelerates all that moves along x.
    void push(Checkpoint& state, double acceleration, double dt) const {
        const auto [name, width, x] = GetParam().method == "rigid_dem" ? std::tuple("state", 5, 2)
                                      : GetParam().method == "sdem"    ? std::tuple("sdem.velocity", 2, 0)
                                      : GetParam().method == "bpm"     ? std::tuple("bpm.v", 2, 0)
                                                                       : std::tuple("mpm.v", 2, 0);
        std::vector<double>& values = state.numbers.at(name);
        for (std::size_t k = static_cast<std::size_t>(x); k < values.size();
             k += static_cast<std::size_t>(width))
            values[k] += acceleration * dt;
    }

    const Packing packing = nine_grains();
};

INSTANTIATE_TEST_SUITE_P(Methods, Watched, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST_P(Watched, ASoundRunKeepsItsLimits) {
    const Scenario s = scenario();
    Spoiled sound = solver(s);
    const RunState end = end_of(s, sound);
    EXPECT_EQ(end.ended, ended_in_order);
    for (const std::string& warning : warnings_of(end.watch, s.watch)) ADD_FAILURE() << warning;
    EXPECT_EQ(end.history.back()[observable_index("warnings")], 0.0);
}

/// A force that nobody accounts for, about that of the walls.
TEST_P(Watched, AWrongForceBreaksMomentumAndEnergy) {
    Scenario s = scenario();
    Spoiled wrong = solver(s);
    Spoiled sound = solver(s);
    const double wall = end_of(s, sound).mean_force[0].norm();
    const GrainView view = sound.view(Need::base);
    double mass = 0.0;
    for (const double m : view.mass) mass += m;
    wrong.state = [&](Checkpoint& state, double dt) { push(state, wall / mass, dt); };
    const RunState end = end_of(s, wrong);
    EXPECT_GT(end.watch.broken[limit("momentum")], 0.0);
    EXPECT_EQ(end.history.back()[observable_index("warnings")], end.watch.all_broken());
    EXPECT_NE(warnings_of(end.watch, s.watch).front().find("was broken at"), std::string::npos);

    s.watch.stop = true;
    Spoiled again = solver(s);
    again.state = wrong.state;
    try {
        end_of(s, again);
        FAIL() << "it went on";
    } catch (const DivergedError& error) {
        EXPECT_NE(std::string(error.what()).find("the limit watch."), std::string::npos) << error.what();
    }
}

TEST_P(Watched, ALedgerThatDoesNotCloseIsFound) {
    const Scenario s = scenario();
    Spoiled wrong = solver(s);
    wrong.seen = [](GrainView& view) { view.energy.external_work *= 3.0; };
    EXPECT_GT(end_of(s, wrong).watch.broken[limit("energy_residual")], 0.0);
}

/// A list of neighbours that is out of date: two grains pass into each other.
TEST_P(Watched, ALostContactIsFound) {
    const Scenario s = scenario();
    Spoiled wrong = solver(s);
    std::vector<Vec2> centroid;
    wrong.seen = [&](GrainView& view) {
        centroid.assign(view.centroid.begin(), view.centroid.end());
        centroid[8] = centroid[0] + Vec2{1.1, 0.0};
        view.centroid = centroid;
    };
    EXPECT_GT(end_of(s, wrong).watch.broken[limit("lost_contacts")], 0.0);
}

TEST_P(Watched, PenetrationAndConvergenceAreFound) {
    Scenario s = scenario();
    s.watch.unconverged = 0.5;
    Spoiled wrong = solver(s);
    double steps = 0.0;
    wrong.seen = [&](GrainView& view) {
        view.contact_report.penetration = 1.0;
        view.contact_report.unconverged_steps = steps += 1e6;  // more than there were
    };
    const RunState end = end_of(s, wrong);
    EXPECT_GT(end.watch.broken[limit("penetration")], 0.0);
    EXPECT_GT(end.watch.broken[limit("unconverged")], 0.0);
    Scenario none = s;
    none.watch = {};
    Spoiled unwatched = solver(none);
    unwatched.seen = wrong.seen;
    EXPECT_EQ(end_of(none, unwatched).watch.all_broken(), 0.0);
}

}  // namespace
}  // namespace softgrain
