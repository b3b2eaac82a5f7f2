#include "common/time_loop.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/observables/observable.hpp"
#include "common/observables/stress.hpp"

namespace softgrain {
namespace {

/// How often between two samples the loop looks whether the stage is over, and begins a mean of the wall
/// forces.
constexpr int checks_per_sample = 8;
/// A method that has left its validity may diverge a few steps later: it must be noticed before.
constexpr int steps_between_validity_checks = 8;

double mean_density(const Scenario& scenario, const Packing& packing) {
    if (scenario.classes.empty()) return scenario.material.density;
    double mass = 0.0, area = 0.0;
    for (std::size_t g = 0; g < packing.size(); ++g) {
        const double squared = packing.radius[g] * packing.radius[g];
        mass += scenario.material_of(packing.class_of(g)).density * squared;
        area += squared;
    }
    return mass / area;
}

}  // namespace

TimeLoop::TimeLoop(const Scenario& scenario, const Packing& packing, Solver& solver,
                   std::vector<Observer*> observers)
    : scenario_(scenario),
      solver_(solver),
      observers_(std::move(observers)),
      undeformed_area_(packing.packing_fraction_undeformed() * packing.box.area()),
      mean_diameter_(2.0 *
                     std::sqrt(undeformed_area_ / static_cast<double>(packing.size()) / std::numbers::pi)),
      density_(mean_density(scenario, packing)),
      checks_before_window_(static_cast<int>(std::lround(
          checks_per_sample * (1.0 - std::max(scenario.sampling.average_window, 1.0 / checks_per_sample))))) {
    state_.box = state_.initial_box = packing.box;
}

void TimeLoop::resume(const RunState& state) {
    state_ = state;
    make_driver();
    for (Observer* observer : observers_) observer->resume(state_.frame_times);
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
    state_.stage_time = 0.0;
    state_.checks = 0;
    state_.stage_packing_fraction = state_.packing_fraction;
    make_driver();
}

void TimeLoop::make_driver() {
    driver_.assign(1,
                   StageDriver(scenario_.loading[static_cast<std::size_t>(state_.stage)], state_.stage,
                               scenario_.sampling, state_.initial_box, state_.stage_box, undeformed_area_));
}

void TimeLoop::go(const std::atomic<int>& stop, const std::function<void()>& after_step) {
    if (driver_.empty()) start();
    while (!finished() && stop.load(std::memory_order_relaxed) == 0) {
        step(driver_.front());
        after_step();
    }
}

void TimeLoop::step(const StageDriver& driver) {
    const double interval = driver.sample_interval();
    const double check_interval = interval / checks_per_sample;
    const double progress = driver.progress(state_.box, state_.stage_time);
    const double tiny = 1e-9 * interval;  // rounding of accumulated wall positions
    const auto reached = [&](double target) { return progress >= target - tiny; };

    const bool at_end = driver.end() && reached(*driver.end());
    if (at_end || reached(check_interval * static_cast<double>(state_.checks + 1))) {
        check(driver, at_end);
        return;
    }

    // Steps of equal length that land on the next sample, or on the end of the stage.
    state_.rate = driver.rate(mean_stress(), solver_.stress_scale(), mean_diameter_, density_);
    const long long samples_done = state_.checks / checks_per_sample;
    double target = interval * static_cast<double>(samples_done + 1);
    if (driver.end()) target = std::min(target, *driver.end());
    const double remaining = (target - progress) / state_.rate;
    const double dt = remaining / std::max(1.0, std::ceil(remaining / solver_.stable_time_step()));

    const WallMotion motion = driver.motion(state_.box, state_.rate, dt);
    solver_.advance(motion, dt);
    state_.box = motion.after(dt);
    state_.time += dt;
    state_.stage_time += dt;
    ++state_.step;
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
    const GrainView view = solver_.view(Need::area);
    state_.packing_fraction = view.covered_area / view.box.area();

    std::string invalid = solver_.outside_validity().value_or("");
    const bool over = at_end || driver.reached(state_.packing_fraction, mean_stress());
    const bool last_stage = state_.stage + 1 == static_cast<int>(scenario_.loading.size());
    if (!invalid.empty()) {
        state_.ended = "left its range of validity: " + invalid;
    } else if (over && last_stage) {
        state_.ended = "loading done";
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

    Need need = Need::base;
    for (const Observable& o : observables()) need = need | o.need;
    for (const Observer* observer : observers_) need = need | observer->need(sample);
    solver_.check_finite();
    const GrainView view = solver_.view(need);

    const Frame frame{view,
                      state_.initial_box,
                      driver.axial_strain(state_.box),
                      driver.strain_rate(state_.rate),
                      density_,
                      state_.initial_energy,
                      state_.mean_force,
                      state_.mean_cell_stress,
                      state_.step};
    std::vector<double> row;
    for (const Observable& o : observables()) row.push_back(o.measure(frame));
    state_.history.push_back(row);
    sample.row = state_.history.back();
    if (sample.is_frame) state_.frame_times.push_back(state_.time);
    for (Observer* observer : observers_) observer->observe(view, sample);
}

double TimeLoop::mean_stress() const {
    return 0.5 * boundary_stress(state_.mean_force, state_.mean_cell_stress, state_.box).trace();
}

double TimeLoop::loading_done() const {
    if (finished()) return 1.0;
    const auto stages = static_cast<double>(scenario_.loading.size());
    const LoadingStage& stage = scenario_.loading[static_cast<std::size_t>(state_.stage)];
    double part = 0.0;
    const auto at_least = [&](double done, double whole) {
        if (whole != 0.0) part = std::max(part, std::clamp(done / whole, 0.0, 1.0));
    };
    const StageDriver& driver = driver_.front();
    if (driver.end()) at_least(driver.progress(state_.box, state_.stage_time), *driver.end());
    if (stage.until_packing_fraction)
        at_least(state_.packing_fraction - state_.stage_packing_fraction,
                 *stage.until_packing_fraction - state_.stage_packing_fraction);
    if (stage.until_stress && !stage.reverse) at_least(mean_stress(), *stage.until_stress);
    return (state_.stage + part) / stages;
}

void RunState::save(Checkpoint& to) const {
    to.put("counters", std::vector<std::int64_t>{step, stage, checks});
    to.put("scalars", std::vector<double>{time, initial_energy, stage_time, stage_packing_fraction,
                                          packing_fraction, impulse_time, rate});
    to.put("box", std::span<const double>(box.position));
    to.put("initial_box", std::span<const double>(initial_box.position));
    to.put("stage_box", std::span<const double>(stage_box.position));
    to.put("impulse", std::span<const Vec2>(impulse));
    to.put("mean_force", std::span<const Vec2>(mean_force));
    to.put("tilt", std::vector<double>{box.tilt, initial_box.tilt, stage_box.tilt});
    to.put("periodic", std::vector<int>{box.periodic ? 1 : 0});
    to.put("cell_stress", std::vector<Mat2>{stress_impulse, mean_cell_stress});
    to.put("frame_times", frame_times);
    std::vector<double> flat;
    for (const auto& row : history) flat.insert(flat.end(), row.begin(), row.end());
    to.put("history", flat);
    to.put("ended", std::vector<int>(ended.begin(), ended.end()));
}

void RunState::load(const Checkpoint& from) {
    std::vector<std::int64_t> counters;
    from.get("counters", counters);
    step = counters.at(0);
    stage = static_cast<int>(counters.at(1));
    checks = counters.at(2);
    std::vector<double> values;
    from.get("scalars", values);
    time = values.at(0);
    initial_energy = values.at(1);
    stage_time = values.at(2);
    stage_packing_fraction = values.at(3);
    packing_fraction = values.at(4);
    impulse_time = values.at(5);
    rate = values.at(6);
    const auto read_box = [&](std::string_view name, Box& into) {
        from.get(name, values);
        for (std::size_t w = 0; w < 4; ++w) into.position[w] = values.at(w);
    };
    read_box("box", box);
    read_box("initial_box", initial_box);
    read_box("stage_box", stage_box);
    std::vector<Vec2> vectors;
    from.get("impulse", vectors);
    for (std::size_t w = 0; w < 4; ++w) impulse[w] = vectors.at(w);
    from.get("mean_force", vectors);
    for (std::size_t w = 0; w < 4; ++w) mean_force[w] = vectors.at(w);
    from.get("tilt", values);
    box.tilt = values.at(0);
    initial_box.tilt = values.at(1);
    stage_box.tilt = values.at(2);
    std::vector<int> flags;
    from.get("periodic", flags);
    box.periodic = initial_box.periodic = stage_box.periodic = flags.at(0) != 0;
    std::vector<Mat2> stresses;
    from.get("cell_stress", stresses);
    stress_impulse = stresses.at(0);
    mean_cell_stress = stresses.at(1);
    from.get("frame_times", frame_times);
    from.get("history", values);
    const std::size_t columns = observables().size();
    history.clear();
    for (std::size_t k = 0; k + columns <= values.size(); k += columns)
        history.emplace_back(values.begin() + static_cast<std::ptrdiff_t>(k),
                             values.begin() + static_cast<std::ptrdiff_t>(k + columns));
    std::vector<int> letters;
    from.get("ended", letters);
    ended.assign(letters.begin(), letters.end());
}

}  // namespace softgrain
