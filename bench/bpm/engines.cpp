// What the two contact engines of BPM cost at equal penetration: sweeps over their knobs, process CPU time of
// one thread, the engines in turn. Usage: bpm_engines [file.csv], or bpm_engines --pair for one setting of
// each engine, with about the same penetration, as CSV.
#include <fmt/format.h>
#include <fmt/os.h>
#include <omp.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <string_view>

#include "bench/bpm/engine_run.hpp"
#include "bench/bpm/front.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

constexpr double target = 1e-3;  // penetration that the engines are compared at [mean disc diameters]

const std::vector<Sample>& samples() {
    static const std::vector<Sample> table{
        // To a strain of 5 % first: 400 discs are 22 d high.
        {"grain", 400, 1, {0.0, 0.0, 0.0, -1.0}, 0.05, 22.0, 0.02, 5.0, 3, 3},
        // From the jamming of the packing on.
        {"packing", 100, 24, {1.0, -1.0, 1.0, -1.0}, 0.1, 10.0, 0.02, 0.8, 5, 1},
    };
    return table;
}

std::vector<Knobs> sweep() {
    std::vector<Knobs> all;
    for (const double tolerance : {1e-2, 3e-3, 1e-3, 1e-4, 1e-5})
        for (const double step : {0.14, 0.07, 0.035}) all.push_back({"nscd", step, tolerance});
    for (const double step : {0.04, 0.02, 0.01, 0.005, 0.0025})
        for (const auto& [velocity, position] : {std::pair{4, 1}, {8, 3}, {16, 8}, {64, 16}}) {
            if (velocity > 8 && step < 0.005) continue;
            if (velocity == 64 && step < 0.02) continue;
            all.push_back({"box2d", step, 1e-4, velocity, position});
        }
    return all;
}

std::string knobs_text(const Knobs& knobs) {
    return knobs.engine == "nscd"
               ? fmt::format("tolerance {:g}", knobs.tolerance)
               : fmt::format("iterations {} / {}", knobs.velocity_iterations, knobs.position_iterations);
}

/// What was found for one setting of the knobs.
struct Summary {
    double cost;                 ///< median of the slices: CPU time per t0 [s]
    double largest, mean;        ///< penetration of all steps, their largest and their mean
    double stress, corrections;  ///< mean stress; energy from position correction / work of the walls
    std::size_t steps;
};

/// One run per seed; none if one of them diverged.
struct Trial {
    Knobs knobs;
    std::vector<std::unique_ptr<EngineRun>> runs;

    Summary summary() const {
        std::vector<double> cost;
        double largest = 0.0, sum = 0.0, stress = 0.0, corrections = 0.0, work = 0.0;
        std::size_t steps = 0;
        for (const auto& run : runs) {
            cost.insert(cost.end(), run->cost().begin(), run->cost().end());
            largest = std::max(largest, std::ranges::max(run->penetration()));
            sum = std::accumulate(run->penetration().begin(), run->penetration().end(), sum);
            stress = std::accumulate(run->stress().begin(), run->stress().end(), stress);
            steps += run->penetration().size();
            corrections += run->corrections();
            work += run->work();
        }
        std::ranges::sort(cost);
        const double count = static_cast<double>(steps);
        return {cost[cost.size() / 2], largest, sum / count, stress / count, corrections / work, steps};
    }
};

template <class Action>
void unless_it_diverges(const Sample& sample, Trial& trial, Action action) {
    try {
        action();
    } catch (const DivergedError& error) {
        fmt::print(stderr, "{}, {}, step {:g}, {}: {}\n", sample.name, trial.knobs.engine, trial.knobs.step,
                   knobs_text(trial.knobs), error.what());
        trial.runs.clear();
    }
}

std::vector<Trial> measure(const Sample& sample, const std::vector<Knobs>& settings) {
    std::vector<Trial> trials;
    for (const Knobs& knobs : settings) {
        Trial trial{knobs, {}};
        unless_it_diverges(sample, trial, [&] {
            for (int seed = 1; seed <= sample.seeds; ++seed)
                trial.runs.push_back(
                    std::make_unique<EngineRun>(sample, knobs, static_cast<std::uint64_t>(seed)));
        });
        trials.push_back(std::move(trial));
    }
    for (int slice = 0; slice < sample.slices; ++slice)
        for (Trial& trial : trials)
            unless_it_diverges(sample, trial, [&] {
                for (const auto& run : trial.runs) run->time_a_slice();
            });
    std::erase_if(trials, [](const Trial& trial) { return trial.runs.empty(); });
    return trials;
}

void print_table(const Sample& sample, const std::vector<Trial>& trials, fmt::ostream* csv) {
    fmt::print(
        "\n{}, timed from a {} on, seeds: {}\n\n| engine | step | knobs | ms per t0 | largest penetration | "
        "mean of the steps' largest | stress | corrections / work |\n|---|--:|---|--:|--:|--:|--:|--:|\n",
        sample.name, trials.at(0).runs.at(0)->state_at_start(), sample.seeds);
    for (const Trial& trial : trials) {
        const Knobs& k = trial.knobs;
        const Summary s = trial.summary();
        fmt::print("| {} | {:g} | {} | {:.2f} | {:.1e} | {:.1e} | {:.3f} | {:.2f} |\n", k.engine, k.step,
                   knobs_text(k), 1e3 * s.cost, s.largest, s.mean, s.stress, s.corrections);
        if (csv)
            csv->print("{},{},{},{},{},{},{:.4e},{:.4e},{:.4e},{:.4f},{:.4f},{}\n", sample.name, k.engine,
                       k.step, k.tolerance, k.velocity_iterations, k.position_iterations, s.cost, s.largest,
                       s.mean, s.stress, s.corrections, s.steps);
    }
}

/// At the target, or at the least penetration that both engines reached.
void print_ratio(const Sample& sample, const std::vector<Trial>& trials, const char* what,
                 double Summary::*penetration) {
    const auto front_of = [&](const char* engine) {
        std::vector<WorkPoint> points;
        for (const Trial& trial : trials) {
            if (trial.knobs.engine != engine) continue;
            const Summary s = trial.summary();
            points.push_back({s.*penetration, s.cost});
        }
        return pareto_front(std::move(points));
    };
    const std::vector<WorkPoint> nscd = front_of("nscd"), box2d = front_of("box2d");
    if (nscd.empty() || box2d.empty()) return;
    const double at = std::max({target, nscd.back().penetration, box2d.back().penetration});
    const double slow = cost_at(box2d, at).value(), fast = cost_at(nscd, at).value();
    fmt::print(
        "{}: at a {} penetration of {:.2e} d{} box2d takes {:.1f} ms per t0, nscd {:.2f}: ratio {:.1f}\n",
        sample.name, what, at, at > target ? " (the least that both reach)" : "", 1e3 * slow, 1e3 * fast,
        slow / fast);
}

/// One setting of each engine at penetrations near the target, by the sweep (engines.csv).
void print_pair() {
    fmt::print("sample,nscd_seconds,box2d_seconds,nscd_penetration,box2d_penetration\n");
    const Knobs nscd{"nscd", 0.07, 1e-3};
    for (const Sample& sample : samples()) {
        const Knobs box2d{"box2d", sample.grains == 1 ? 0.005 : 0.0025, 1e-4, 4, 1};
        const std::vector<Trial> trials = measure(sample, {nscd, box2d});
        if (trials.size() != 2) continue;
        const Summary ours = trials[0].summary(), theirs = trials[1].summary();
        fmt::print("{},{:.4e},{:.4e},{:.4e},{:.4e}\n", sample.name, ours.cost, theirs.cost, ours.largest,
                   theirs.largest);
    }
}

}  // namespace
}  // namespace softgrain::bpm

int main(int argc, char** argv) {
    using namespace softgrain::bpm;
    omp_set_num_threads(1);
    if (argc > 1 && std::string_view(argv[1]) == "--pair") {
        print_pair();
        return 0;
    }
    std::unique_ptr<fmt::ostream> csv;
    if (argc > 1) {
        csv = std::make_unique<fmt::ostream>(fmt::output_file(argv[1]));
        csv->print(
            "sample,engine,step,tolerance,velocity_iterations,position_iterations,cpu_seconds_per_t0,"
            "largest_penetration,mean_penetration,stress,correction_share,steps\n");
    }
    for (const Sample& sample : samples()) {
        const std::vector<Trial> trials = measure(sample, sweep());
        print_table(sample, trials, csv.get());
        fmt::print("\n");
        print_ratio(sample, trials, "largest", &Summary::largest);
        print_ratio(sample, trials, "mean", &Summary::mean);
    }
    return 0;
}
