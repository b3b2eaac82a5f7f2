// What the two contact engines of BPM cost at equal penetration: sweeps over their knobs, process CPU time of
// one thread, the engines in turn. Usage: bpm_engines [file.csv]
#include <fmt/format.h>
#include <fmt/os.h>
#include <omp.h>

#include <memory>

#include "bench/bpm/engine_run.hpp"
#include "bench/bpm/front.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

constexpr double target = 1e-3;  // penetration that the engines are compared at [mean disc diameters]

const std::vector<Sample>& samples() {
    static const std::vector<Sample> table{
        // To a strain of 5 % first: 400 discs are 22 d high.
        {"grain", 400, 1, {0.0, 0.0, 0.0, -1.0}, 0.05, 22.0, 0.02, 5.0, 5},
        // From the jamming of its discs to a packing fraction of about 0.85.
        {"packing", 100, 24, {1.0, -1.0, 1.0, -1.0}, 0.1, 12.0, 0.02, 1.2, 5},
    };
    return table;
}

std::vector<Knobs> sweep(const Sample& sample) {
    std::vector<Knobs> all;
    for (const double tolerance : {1e-2, 3e-3, 1e-3, 1e-4, 1e-5})
        for (const double step : {0.14, 0.07, 0.035}) all.push_back({"nscd", step, tolerance});
    const bool small = sample.grains == 1;
    for (const double step : {0.04, 0.02, 0.01, 0.005, 0.0025})
        for (const auto& [velocity, position] : {std::pair{4, 1}, {8, 3}, {16, 8}, {64, 16}}) {
            if (velocity > 8 && step < 0.005) continue;
            if (!small && velocity == 64 && step < 0.01) continue;
            all.push_back({"box2d", step, 1e-4, velocity, position});
        }
    return all;
}

std::string knobs_text(const Knobs& knobs) {
    return knobs.engine == "nscd"
               ? fmt::format("tolerance {:g}", knobs.tolerance)
               : fmt::format("iterations {} / {}", knobs.velocity_iterations, knobs.position_iterations);
}

/// A run that diverged is no longer there.
struct Trial {
    Knobs knobs;
    std::unique_ptr<EngineRun> run;
};

template <class Action>
void unless_it_diverges(const Sample& sample, Trial& trial, Action action) {
    try {
        action();
    } catch (const DivergedError& error) {
        fmt::print(stderr, "{}, {}, step {:g}, {}: {}\n", sample.name, trial.knobs.engine, trial.knobs.step,
                   knobs_text(trial.knobs), error.what());
        trial.run.reset();
    }
}

std::vector<Trial> measure(const Sample& sample) {
    std::vector<Trial> trials;
    for (const Knobs& knobs : sweep(sample)) {
        Trial trial{knobs, nullptr};
        unless_it_diverges(sample, trial, [&] { trial.run = std::make_unique<EngineRun>(sample, knobs); });
        trials.push_back(std::move(trial));
    }
    for (int slice = 0; slice < sample.slices; ++slice)
        for (Trial& trial : trials)
            if (trial.run) unless_it_diverges(sample, trial, [&] { trial.run->time_a_slice(); });
    return trials;
}

void print_table(const Sample& sample, std::vector<Trial>& trials, fmt::ostream* csv) {
    fmt::print(
        "\n{}\n\n| engine | step | knobs | ms per t0 | largest penetration | mean of the steps' largest | "
        "stress | corrections / work |\n|---|--:|---|--:|--:|--:|--:|--:|\n",
        sample.name);
    for (Trial& trial : trials) {
        if (!trial.run) continue;
        const Knobs& k = trial.knobs;
        EngineRun& run = *trial.run;
        const double share = run.correction_share();
        fmt::print("| {} | {:g} | {} | {:.2f} | {:.1e} | {:.1e} | {:.3f} | {:.2f} |\n", k.engine, k.step,
                   knobs_text(k), 1e3 * run.cost(), run.largest_penetration(), run.mean_penetration(),
                   run.mean_stress(), share);
        if (csv)
            csv->print("{},{},{},{},{},{},{:.4e},{:.4e},{:.4e},{:.4f},{:.4f},{}\n", sample.name, k.engine,
                       k.step, k.tolerance, k.velocity_iterations, k.position_iterations, run.cost(),
                       run.largest_penetration(), run.mean_penetration(), run.mean_stress(), share,
                       run.steps());
    }
}

/// At the target, or at the least penetration that both engines reached.
void print_ratio(const Sample& sample, const std::vector<Trial>& trials, const char* what,
                 double (EngineRun::*penetration)() const) {
    const auto front_of = [&](const char* engine) {
        std::vector<WorkPoint> points;
        for (const Trial& trial : trials)
            if (trial.run && trial.knobs.engine == engine)
                points.push_back({(*trial.run.*penetration)(), trial.run->cost()});
        return pareto_front(std::move(points));
    };
    const std::vector<WorkPoint> nscd = front_of("nscd"), box2d = front_of("box2d");
    if (nscd.empty() || box2d.empty()) return;
    const double at = std::max({target, nscd.back().penetration, box2d.back().penetration});
    const double ratio = cost_at(box2d, at).value() / cost_at(nscd, at).value();
    fmt::print(
        "{}: at a {} penetration of {:.2e} d{} box2d takes {:.1f} ms per t0, nscd {:.2f}: ratio {:.1f}\n",
        sample.name, what, at, at > target ? " (the least that both reach)" : "",
        1e3 * cost_at(box2d, at).value(), 1e3 * cost_at(nscd, at).value(), ratio);
}

}  // namespace
}  // namespace softgrain::bpm

int main(int argc, char** argv) {
    using namespace softgrain::bpm;
    omp_set_num_threads(1);
    std::unique_ptr<fmt::ostream> csv;
    if (argc > 1) {
        csv = std::make_unique<fmt::ostream>(fmt::output_file(argv[1]));
        csv->print(
            "sample,engine,step,tolerance,velocity_iterations,position_iterations,cpu_seconds_per_t0,"
            "largest_penetration,mean_penetration,stress,correction_share,steps\n");
    }
    for (const Sample& sample : samples()) {
        std::vector<Trial> trials = measure(sample);
        print_table(sample, trials, csv.get());
        fmt::print("\n");
        print_ratio(sample, trials, "largest", &EngineRun::largest_penetration);
        print_ratio(sample, trials, "mean", &EngineRun::mean_penetration);
    }
    return 0;
}
