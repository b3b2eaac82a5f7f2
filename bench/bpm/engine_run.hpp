#pragma once
// One sample under one engine, loaded at constant wall speed and timed in slices.
#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

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
    int slices;
};

inline double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// One grain just between two walls, the other two out of reach; or a jammed packing.
class EngineRun {
  public:
    EngineRun(const Sample& sample, const Knobs& knobs)
        : sample_(sample),
          packing_(packing_of(sample)),
          solver_(scenario_of(sample, knobs), packing_),
          box_(packing_.box),
          t0_(solver_.stable_time_step() / knobs.step) {
        if (sample.grains == 1) {
            const auto [low, high] = extent(1);
            box_.position[2] = low;
            box_.position[3] = high;
        }
        advance(sample.start_speed, sample.start_time);
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

    /// Median over the slices: CPU time per t0 [s].
    double cost() const {
        std::vector<double> sorted = cost_;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
    /// Of all steps that were timed [mean disc diameters].
    double largest_penetration() const { return *std::max_element(deepest_.begin(), deepest_.end()); }
    double mean_penetration() const { return mean_of(deepest_); }
    double mean_stress() const { return mean_of(stress_); }  ///< on the moving walls [F0/<a0>]
    std::size_t steps() const { return deepest_.size(); }
    /// Energy that position correction gave the discs / work of the walls.
    double correction_share() {
        return (solver_.correction_energy() - corrections_) /
               (solver_.view(Need::base).energy.external_work - work_);
    }

  private:
    static double mean_of(const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
    }
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
    static Scenario scenario_of(const Sample& sample, const Knobs& knobs) {
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
        scenario.method_settings.insert_or_assign("bpm", settings);
        return scenario;
    }
    std::pair<double, double> extent(int axis) const {
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (std::size_t d = 0; d < solver_.disc_position().size(); ++d) {
            low = std::min(low, solver_.disc_position()[d][axis] - solver_.disc_radius()[d]);
            high = std::max(high, solver_.disc_position()[d][axis] + solver_.disc_radius()[d]);
        }
        return {low, high};
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
            stress_.push_back(stress());
        }
    }
    /// Force on the top and bottom over the grain's width, or on all walls over their length.
    double stress() const {
        const auto& force = solver_.wall_force();
        const double vertical = force[3].y() - force[2].y();
        if (sample_.grains > 1)
            return 0.25 * (vertical / box_.width() + (force[1].x() - force[0].x()) / box_.height());
        const auto [left, right] = extent(0);
        return 0.5 * vertical / (right - left);
    }

    Sample sample_;
    Packing packing_;
    BpmSolver solver_;
    Box box_;
    double t0_;  ///< sqrt(m d / F0) [s]
    double work_ = 0.0, corrections_ = 0.0;
    std::vector<double> cost_, deepest_, stress_;
};

}  // namespace softgrain::bpm
