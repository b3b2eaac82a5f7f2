#include "app/bench/stability/step_map.hpp"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "app/bench/stability/largest_stable.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

constexpr int steps_to_settle = 64;
constexpr long long steps_between_looks = 50;
constexpr double squeeze_time = 40.0, rest_time = 150.0;  ///< [waves through a grain]

std::vector<std::string> words(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> all;
    for (std::string word; stream >> word;) all.push_back(word);
    return all;
}

/// One cell: a state at rest, and how long a step it stands.
class CellSearch {
  public:
    CellSearch(const MapPlan& plan, const MapCell& cell)
        : plan_(plan),
          spec_{plan.method,          plan.set, plan.grains, cell.poisson_ratio, cell.size_ratio,
                cell.stiffness_ratio, false},
          damping_(words(cell.damping)),
          scene_(make_scene(spec_)) {
        prepare(cell.phi);
    }

    double largest() {
        return largest_stable([&](double factor) { return is_stable(factor); });
    }
    double default_step() { return settled(with_keys(spec_, damping_)).solver().stable_time_step(); }
    double predicted_step() { return settled(with_safety(1.0)).solver().stable_time_step(); }

  private:
    /// With the method's own damping, whatever the cell's is.
    void prepare(double phi) {
        Motion motion(find_method(plan_.method).make(scene_.scenario, scene_.packing), scene_.packing.box);
        const double wave = crossing_time(scene_, motion.solver());
        const double now = scene_.packing.packing_fraction_undeformed();
        motion.squeeze(1.0 - std::sqrt(now / phi), squeeze_time * wave);
        motion.squeeze(0.0, rest_time * wave);
        motion.solver().save(state_);
        box_ = motion.box();
    }

    /// The value may lie beyond what a scenario file may say.
    Scenario with_safety(double value) {
        Scenario scenario = with_keys(spec_, damping_);
        if (const auto dot = plan_.safety_key.find('.'); dot != std::string::npos)
            scenario.method_settings.at(plan_.safety_key.substr(0, dot))
                .set(plan_.safety_key.substr(dot + 1), value);
        return scenario;
    }

    /// In the state at rest, after so many steps of half the length that the step is this scenario's own and
    /// no longer that of the state.
    Motion settled(const Scenario& scenario) {
        Motion motion(find_method(plan_.method).make(scenario, scene_.packing), scene_.packing.box);
        motion.load(state_, box_);
        for (int k = 0; k < steps_to_settle; ++k) motion.step(0.5);
        return motion;
    }

    bool is_stable(double factor) {
        try {
            Motion motion = settled(with_safety(plan_.factor_by_key ? factor : 1.0));
            const double times = plan_.factor_by_key ? 1.0 : factor;
            const EnergyLedger start = motion.energy();
            const double bound = std::max(most_growth * start.kinetic, noise * std::abs(start.elastic));
            for (long long k = 1; k <= plan_.steps; ++k) {
                motion.step(times);
                if (k % steps_between_looks != 0 && k != plan_.steps) continue;
                motion.solver().check_finite();
                if (!(motion.energy().kinetic <= bound)) return false;
            }
            return true;
        } catch (const DivergedError&) {
            return false;
        }
    }

    const MapPlan& plan_;
    SceneSpec spec_;
    std::vector<std::string> damping_;
    Scene scene_;
    Checkpoint state_;
    Box box_;
};

MapRow row_of(const MapPlan& plan, const MapCell& cell) {
    MapRow row{&plan, cell};
    try {
        CellSearch search(plan, cell);
        row.step = search.default_step();
        row.safety = row.step / search.predicted_step();
        row.largest = search.largest();
    } catch (const std::runtime_error& error) {  // refused, or diverged before there was a state at rest
        row.not_measured = error.what();
    }
    return row;
}

}  // namespace

std::vector<MapRow> step_map(const MapPlan& plan) {
    std::vector<MapRow> rows;
    for (const double stiffness : plan.stiffness_ratio)
        for (const double size : plan.size_ratio)
            for (const double nu : plan.poisson_ratio)
                for (const std::string& damping : plan.damping)
                    for (const double phi : plan.phi) {
                        if (stop_signal() != 0) return rows;
                        rows.push_back(row_of(plan, {phi, nu, size, stiffness, damping}));
                    }
    return rows;
}

}  // namespace softgrain::bench
