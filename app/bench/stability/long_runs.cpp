#include "app/bench/stability/long_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/methods.hpp"
#include "app/process.hpp"

namespace softgrain::bench {
namespace {

constexpr double fast = 10.0, slow = 60.0, rest_time = 2000.0;  ///< [waves through a grain]
constexpr long long looks = 1000;                               ///< at the energy, in a run

class LongRun {
  public:
    explicit LongRun(const LongPlan& plan)
        : plan_(plan),
          scene_(make_scene(plan.scene)),
          motion_(find_method(plan.scene.method).make(scene_.scenario, scene_.packing), scene_.packing.box),
          wave_(crossing_time(scene_, motion_.solver())) {}

    LongRow run() {
        LongRow row{.plan = &plan_};
        const double begin = motion_.solver().view(Need::base).time;
        switch (plan_.kind) {
            case LongKind::drift:
                drift(row);
                break;
            case LongKind::cycle:
                cycle(row);
                break;
            case LongKind::rest:
                rest(row);
                break;
        }
        row.waves = (motion_.solver().view(Need::base).time - begin) / wave_;
        return row;
    }

  private:
    void squeeze_to_phi(double waves) {
        const double now = scene_.packing.packing_fraction_undeformed();
        motion_.squeeze(1.0 - std::sqrt(now / plan_.phi), waves * wave_);
    }
    double mechanical() {
        const EnergyLedger e = motion_.energy();
        return e.kinetic + e.elastic;
    }

    void drift(LongRow& row) {
        squeeze_to_phi(fast);
        const double start = mechanical();
        const long long interval = std::max(1LL, plan_.steps / looks);
        std::vector<double> energy;
        for (; row.steps < plan_.steps; row.steps += interval) {
            motion_.hold(interval);
            energy.push_back(mechanical());
            row.largest = std::max(row.largest, std::abs(energy.back() / start - 1.0));
        }
        const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, energy.size() / 10));
        const auto mean = [&](auto from) {
            double sum = 0.0;
            for (auto e = from; e != from + tenth; ++e) sum += *e;
            return sum / static_cast<double>(tenth);
        };
        row.change = (mean(energy.end() - tenth) - mean(energy.begin())) / start;
    }

    void cycle(LongRow& row) {
        squeeze_to_phi(slow);
        motion_.squeeze(0.0, rest_time * wave_);
        const double time = 0.5 * static_cast<double>(plan_.steps) * motion_.solver().stable_time_step();
        const EnergyLedger start = motion_.energy();
        const auto residual = [&](const EnergyLedger& e) {
            return std::abs((e.external_work - start.external_work) - (e.kinetic - start.kinetic) -
                            (e.elastic - start.elastic) - (e.dissipated() - start.dissipated()));
        };
        motion_.squeeze(plan_.strain, time);
        const EnergyLedger there = motion_.energy();
        const double work = there.external_work - start.external_work;
        motion_.squeeze(-plan_.strain / (1.0 - plan_.strain), time);
        const EnergyLedger back = motion_.energy();
        row.steps = plan_.steps;
        row.change = (back.external_work - start.external_work) / work;
        row.largest = std::max(residual(there), residual(back)) / work;
    }

    void rest(LongRow& row) {
        squeeze_to_phi(slow);
        motion_.squeeze(0.0, rest_time * wave_);
        const GrainView view = motion_.solver().view(Need::base);
        const std::vector<Vec2> start(view.centroid.begin(), view.centroid.end());
        const double elastic = view.energy.elastic;
        double radii = 0.0;
        for (const double r : scene_.packing.radius) radii += r;
        const double mean_radius = radii / static_cast<double>(start.size());
        const long long interval = std::max(1LL, plan_.steps / looks);
        for (; row.steps < plan_.steps; row.steps += interval) {
            motion_.hold(interval);
            const GrainView now = motion_.solver().view(Need::base);
            for (std::size_t g = 0; g < start.size(); ++g)
                row.change = std::max(row.change, (now.centroid[g] - start[g]).norm() / mean_radius);
            row.largest = std::max(row.largest, std::abs(now.energy.elastic / elastic - 1.0));
        }
    }

    const LongPlan& plan_;
    Scene scene_;
    Motion motion_;
    double wave_;
};

}  // namespace

std::vector<LongRow> long_runs(const std::vector<LongPlan>& plans, const std::vector<std::string>& methods) {
    std::vector<LongRow> rows;
    for (const LongPlan& plan : plans) {
        if (std::ranges::find(methods, plan.scene.method) == methods.end()) continue;
        if (stop_signal() != 0) return rows;
        try {
            rows.push_back(LongRun(plan).run());
        } catch (const std::runtime_error& error) {  // refused or diverged
            rows.push_back({.plan = &plan, .failed = error.what()});
        }
        const LongRow& row = rows.back();
        fmt::print("{}: {} steps, change {:.3g}, largest {:.3g} {}\n", plan.name, row.steps, row.change,
                   row.largest, row.failed);
        std::fflush(stdout);
    }
    return rows;
}

}  // namespace softgrain::bench
