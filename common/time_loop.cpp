#include "common/time_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/observables/stress.hpp"
#include "common/state_hash.hpp"
#include "common/stop.hpp"

namespace softgrain {
namespace {

/// How often between two samples the loop looks whether the stage is over, and begins a mean of the wall
/// forces.
constexpr int checks_per_sample = 8;
/// A method that has left its validity may diverge a few steps later: it must be noticed before.
constexpr int steps_between_validity_checks = 8;
constexpr double rounding_of_time = 1e-12;  // relative, of a sum of steps

double mean_density(const Scenario& scenario, const Packing& packing) {
    if (scenario.classes.empty()) return scenario.material.density;
    double mass = 0.0, area = 0.0;
    for (std::size_t g = 0; g < packing.free_size(); ++g) {
        const double squared = packing.radius[g] * packing.radius[g];
        mass += scenario.material_of(packing.class_of(g)).density * squared;
        area += squared;
    }
    return mass / area;
}

Grains grains_of(const Scenario& scenario, const Packing& packing, const Solver& solver) {
    const double area = packing.packing_fraction_undeformed() * packing.box.area();
    return {area, 2.0 * std::sqrt(area / static_cast<double>(packing.free_size()) / std::numbers::pi),
            mean_density(scenario, packing), solver.stress_scale()};
}

}  // namespace

TimeLoop::TimeLoop(const Scenario& scenario, const Packing& packing, Solver& solver,
                   std::vector<Observer*> observers)
    : scenario_(scenario),
      solver_(solver),
      observers_(std::move(observers)),
      order_(stage_order(scenario.loading)),
      grains_(grains_of(scenario, packing, solver)),
      watchdog_(scenario.watch, packing, grains_.mean_diameter),
      checks_before_window_(static_cast<int>(std::lround(
          checks_per_sample * (1.0 - std::max(scenario.sampling.average_window, 1.0 / checks_per_sample))))) {
    state_.box = state_.initial_box = packing.box;
}

std::vector<std::string> TimeLoop::resume(const RunState& state) {
    state_ = state;
    make_driver();
    std::vector<std::string> lost;
    for (Observer* observer : observers_) {
        const std::vector<std::string> lines = observer->resume(state_.frame_times);
        lost.insert(lost.end(), lines.begin(), lines.end());
    }
    return lost;
}

void TimeLoop::branch(const RunState& state) {
    state_ = state;
    state_.ended.clear();
    state_.watch = {};
    state_.history.clear();
    state_.state_hashes.clear();
    state_.frame_times.clear();
    begin_stage(state_.stage + 1);
    sample(driver_.front(), false);
}

void TimeLoop::start() {
    const GrainView view = solver_.view(Need::area);
    state_.initial_energy = view.energy.kinetic + view.energy.elastic;
    state_.packing_fraction = view.covered_area / view.box.area();
    state_.mean_force = solver_.wall_force();
    if (state_.box.periodic) state_.mean_cell_stress = solver_.cell_stress();
    begin_stage(0);
    sample(driver_.front(), false);
}

void TimeLoop::begin_stage(int stage) {
    state_.stage = stage;
    state_.stage_box = state_.box;
    const Mat2 stress = mean_boundary_stress();
    state_.stage_stress = {stress(0, 0), stress(1, 1)};
    state_.stage_time = state_.most_strain = 0.0;
    state_.checks = 0;
    state_.stage_packing_fraction = state_.packing_fraction;
    make_driver();
    if (const auto& servo = driver_.front().servo())
        state_.servo = servo->begin(state_.servo, state_.box, state_.stage_stress, grains_.stress_scale);
}

void TimeLoop::make_driver() {
    driver_.assign(1, StageDriver(stage(), order_[static_cast<std::size_t>(state_.stage)], scenario_.sampling,
                                  state_.initial_box, {state_.stage_box, state_.stage_stress}, grains_));
}

const LoadingStage& TimeLoop::stage() const {
    return scenario_.loading[order_[static_cast<std::size_t>(state_.stage)]];
}

void TimeLoop::go(const std::atomic<int>& stop, const std::function<void()>& after_step) {
    if (driver_.empty()) start();
    while (!finished() && stop.load(std::memory_order_relaxed) == 0) {
        try {
            step(driver_.front());
        } catch (const StopAsked&) {
            return;
        }
        after_step();
    }
}

void TimeLoop::step(const StageDriver& driver) {
    const double interval = driver.sample_interval();
    const double check_interval = interval / checks_per_sample;
    const double progress = driver.progress(state_.box, state_.stage_time, state_.most_strain);
    const double tiny = 1e-9 * interval;  // rounding of accumulated wall positions
    const auto reached = [&](double target) { return progress >= target - tiny; };

    const auto end_time = driver.end_time();
    const bool at_end = (driver.end() && reached(*driver.end())) ||
                        (end_time && state_.stage_time >= *end_time * (1.0 - rounding_of_time));
    if (at_end || reached(check_interval * static_cast<double>(state_.checks + 1))) {
        check(driver, at_end);
        return;
    }

    // Steps of equal length that land on the next sample, or on the end of the stage.
    state_.rate = driver.rate(mean_stress());
    const long long samples_done = state_.checks / checks_per_sample;
    double target = interval * static_cast<double>(samples_done + 1);
    if (driver.end()) target = std::min(target, *driver.end());
    double remaining = (target - progress) / state_.rate;
    if (end_time) remaining = std::min(remaining, *end_time - state_.stage_time);
    const double dt = remaining / std::max(1.0, std::ceil(remaining / solver_.stable_time_step()));

    const WallMotion motion = driver.motion(state_.box, state_.rate, state_.servo, dt);
    const std::array<Vec2, 4> force_before = solver_.wall_force();
    solver_.advance(motion, dt);
    watchdog_.add_step(state_.watch, force_before, solver_.wall_force(), dt);
    state_.box = motion.after(dt);
    state_.time += dt;
    state_.stage_time += dt;
    state_.most_strain += state_.rate * dt;
    ++state_.step;
    if (const auto& servo = driver.servo())
        servo->update(state_.servo, state_.box, present_stress(), driver.servo_limit(state_.rate), dt);
    for (std::size_t w = 0; w < 4; ++w) state_.impulse[w] += solver_.wall_force()[w] * dt;
    if (state_.box.periodic) state_.stress_impulse += solver_.cell_stress() * dt;
    state_.impulse_time += dt;
    if (state_.step % steps_between_validity_checks == 0 && solver_.outside_validity()) check(driver, false);
}

void TimeLoop::check(const StageDriver& driver, bool at_end) {
    if (!at_end) ++state_.checks;
    solver_.check_finite();
    if (state_.impulse_time > 0.0) {
        for (std::size_t w = 0; w < 4; ++w) state_.mean_force[w] = state_.impulse[w] / state_.impulse_time;
        state_.mean_cell_stress = state_.stress_impulse / state_.impulse_time;
    }
    if (state_.checks % checks_per_sample <= checks_before_window_) {
        for (Vec2& impulse : state_.impulse) impulse.setZero();
        state_.stress_impulse.setZero();
        state_.impulse_time = 0.0;
    }
    const GrainView view = solver_.view(driver.wants_unbalanced() ? Need::area | Need::contacts : Need::area);
    state_.packing_fraction = view.covered_area / view.box.area();
    const Answer answer{state_.packing_fraction, mean_boundary_stress(),
                        driver.wants_unbalanced() ? unbalanced_force(view) : 0.0};

    std::string invalid = solver_.outside_validity().value_or("");
    const bool over = at_end || driver.reached(answer, state_.box, state_.servo);
    const bool last_stage = state_.stage + 1 == static_cast<int>(order_.size());
    if (!invalid.empty()) {
        state_.ended = "left its range of validity: " + invalid;
    } else if (over && last_stage) {
        state_.ended = ended_in_order;
    }
    if (over || finished() || state_.checks % checks_per_sample == 0) sample(driver, finished());
    if (over && !finished()) begin_stage(state_.stage + 1);
}

void TimeLoop::sample(const StageDriver& driver, bool last) {
    const auto index = static_cast<int>(state_.history.size());
    Sample sample;
    sample.index = index;
    sample.is_frame = last || index % scenario_.sampling.frame_every == 0;
    sample.frame = static_cast<int>(state_.frame_times.size());
    sample.step = state_.step;
    sample.loading = loading_done();

    Need need = hashed;
    for (const Observable& o : observables()) need = need | o.need;
    for (const Observer* observer : observers_) need = need | observer->need(sample);
    solver_.check_finite();
    const GrainView view = solver_.view(need);

    const std::vector<BrokenLimit> broken =
        watchdog_.check(state_.watch, view, state_.initial_energy, static_cast<double>(state_.step));
    const Frame frame{view,
                      state_.initial_box,
                      driver.axial_strain(state_.box),
                      driver.strain_rate(state_.rate, state_.servo),
                      grains_.density,
                      state_.initial_energy,
                      state_.mean_force,
                      state_.mean_cell_stress,
                      state_.step,
                      state_.stage,
                      state_.watch.all_broken()};
    std::vector<double> row;
    for (const Observable& o : observables()) row.push_back(o.measure(frame));
    state_.history.push_back(row);
    state_.state_hashes.push_back(static_cast<std::int64_t>(state_hash(view)));
    sample.row = state_.history.back();
    if (sample.is_frame) state_.frame_times.push_back(state_.time);
    for (Observer* observer : observers_) observer->observe(view, sample);
    if (scenario_.watch.stop && !broken.empty())
        throw DivergedError(-1, std::string(watch_limits[broken.front().limit]), state_.time,
                            broken.front().why);
}

Mat2 TimeLoop::mean_boundary_stress() const {
    return boundary_stress(state_.mean_force, state_.mean_cell_stress, state_.box);
}

std::array<double, 2> TimeLoop::present_stress() const {
    const Mat2 stress = boundary_stress(
        solver_.wall_force(), state_.box.periodic ? solver_.cell_stress() : Mat2::Zero(), state_.box);
    return {stress(0, 0), stress(1, 1)};
}

double TimeLoop::loading_done() const {
    if (finished()) return 1.0;
    const auto stages = static_cast<double>(order_.size());
    const LoadingStage& stage = this->stage();
    double part = 0.0;
    const auto at_least = [&](double done, double whole) {
        if (whole != 0.0) part = std::max(part, std::clamp(done / whole, 0.0, 1.0));
    };
    const StageDriver& driver = driver_.front();
    if (driver.end())
        at_least(driver.progress(state_.box, state_.stage_time, state_.most_strain), *driver.end());
    if (const auto time = driver.end_time()) at_least(state_.stage_time, *time);
    if (stage.seeks_stress()) at_least(state_.servo.way, 1.0);
    if (stage.until_packing_fraction)
        at_least(state_.packing_fraction - state_.stage_packing_fraction,
                 *stage.until_packing_fraction - state_.stage_packing_fraction);
    if (stage.until_stress && !stage.reverse) at_least(mean_stress(), *stage.until_stress);
    return (state_.stage + part) / stages;
}

}  // namespace softgrain
