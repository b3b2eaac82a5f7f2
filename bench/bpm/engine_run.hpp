#pragma once
// One sample under one engine, loaded at constant wall speed and timed in slices.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "bpm/grain_compression.hpp"
#include "bpm/method.hpp"
#include "bpm/solver.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain::bpm {

/// What is varied of an engine.
struct Knobs {
    std::string engine;
    double step;                                           ///< [sqrt(m d / F0)]
    double tolerance = 1e-4;                               ///< of nscd [mean disc diameters]
    int velocity_iterations = 0, position_iterations = 0;  ///< of Box2D
};

/// A sample and how it is loaded; lengths in disc diameters d, times in t0 = sqrt(m d / F0).
struct Sample {
    std::string name;
    int discs_per_grain;
    int grains;
    std::array<double, 4> wall;  ///< directions that the walls move in
    double start_speed, start_time;
    double speed, slice_time;
    int slices, seeds;
};

inline double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// One grain just between two walls, the other two out of reach; or a jammed packing.
class EngineRun {
  public:
    EngineRun(const Sample& sample, const Knobs& knobs, std::uint64_t seed)
        : sample_(sample),
          packing_(packing_of(sample)),
          solver_(scenario_of(sample, knobs, seed), packing_),
          box_(packing_.box),
          t0_(solver_.stable_time_step() / knobs.step) {
        if (sample.grains == 1) {
            const auto [low, high] = extent_of_discs(solver_, 1);
            box_.position[2] = low;
            box_.position[3] = high;
        }
        const double height = box_.height();
        advance(sample.start_speed, sample.start_time);
        state_ = sample.grains == 1 ? fmt::format("strain {:.3f}", 1.0 - box_.height() / height)
                                    : fmt::format("packing fraction {:.3f}",
                                                  solver_.view(Need::area).covered_area / box_.area());
        deepest_.clear();
        stress_.clear();
        work_ = solver_.view(Need::base).energy.external_work;
        corrections_ = solver_.correction_energy();
    }

    void time_a_slice() {
        const double start = cpu_seconds();
        advance(sample_.speed, sample_.slice_time);
        cost_.push_back((cpu_seconds() - start) / sample_.slice_time);
    }

    const std::string& state_at_start() const { return state_; }
    const std::vector<double>& cost() const { return cost_; }  ///< [slices] CPU time per t0 [s]
    /// Of each step that was timed: largest penetration [mean disc diameters], stress on the moving walls
    /// [F0/<a0>].
    const std::vector<double>& penetration() const { return deepest_; }
    const std::vector<double>& stress() const { return stress_; }
    /// Of the walls, since the timing began [J].
    double work() { return solver_.view(Need::base).energy.external_work - work_; }
    /// That position correction gave the discs since then [J].
    double corrections() const { return solver_.correction_energy() - corrections_; }

  private:
    static Packing packing_of(const Sample& sample) {
        if (sample.grains > 1) {
            Scenario scenario;
            scenario.packing.count = sample.grains;
            return make_packing(scenario);
        }
        Packing packing;
        packing.box.position = {-3.0, 3.0, -1.5, 1.5};
        packing.center = {Vec2::Zero()};
        packing.radius = {1.0};
        return packing;
    }
    /// Units of stress F0/<a0> = 1.
    static Scenario scenario_of(const Sample& sample, const Knobs& knobs, std::uint64_t seed) {
        Settings settings(method().keys());
        settings.set("engine", knobs.engine);
        settings.set("discs_per_grain", std::int64_t{sample.discs_per_grain});
        settings.set("attraction_stress", 1.0);
        settings.set("step", knobs.step);
        settings.set("tolerance", knobs.tolerance);
        if (knobs.engine == "box2d") {
            settings.set("box2d_velocity_iterations", std::int64_t{knobs.velocity_iterations});
            settings.set("box2d_position_iterations", std::int64_t{knobs.position_iterations});
        }
        Scenario scenario;
        scenario.seed = seed;
        scenario.method_settings.insert_or_assign("bpm", settings);
        return scenario;
    }
    void advance(double speed, double time) {
        const long steps = std::lround(time * t0_ / solver_.stable_time_step());
        const double dt = time * t0_ / static_cast<double>(steps);
        const double wall_speed = speed * solver_.mean_disc_diameter() / t0_;
        for (long k = 0; k < steps; ++k) {
            WallMotion walls{box_, sample_.wall};
            for (double& v : walls.velocity) v *= wall_speed;
            solver_.advance(walls, dt);
            box_ = walls.after(dt);
            deepest_.push_back(solver_.penetration());
            stress_.push_back(stress_now());
        }
    }
    /// Force on the top and bottom over the grain's width, or on all walls over their length.
    double stress_now() const {
        const auto& force = solver_.wall_force();
        const double vertical = force[3].y() - force[2].y();
        if (sample_.grains > 1)
            return 0.25 * (vertical / box_.width() + (force[1].x() - force[0].x()) / box_.height());
        return 0.5 * vertical / extent_of_discs(solver_, 0).length();
    }

    Sample sample_;
    Packing packing_;
    BpmSolver solver_;
    Box box_;
    std::string state_;
    double t0_;  ///< sqrt(m d / F0) [s]
    double work_ = 0.0, corrections_ = 0.0;
    std::vector<double> cost_, deepest_, stress_;
};

}  // namespace softgrain::bpm
