#include "app/bench/commands.hpp"

#include <fmt/format.h>

#include <memory>

#include "app/bench/peers/bench_peers.hpp"
#include "app/bench/scaling/bench_scaling.hpp"
#include "app/bench/scaling/steps.hpp"
#include "app/process.hpp"

namespace softgrain::bench {
namespace {

CLI::App& add(CLI::App& bench, const char* name, const char* help, const char* example) {
    CLI::App& command = *bench.add_subcommand(name, help);
    command.footer(fmt::format("Example:\n  softgrain bench {} {}", name, example));
    return command;
}

void add_steps(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command = add(bench, "steps", "what a number of steps of a scenario costs, as a line of JSON",
                            "scenarios/default.toml --method sdem --warm-up 100 --steps 1000");
    const auto request = std::make_shared<StepsRequest>();
    command.add_option("scenario", request->scenario, "scenario file (TOML)")->required();
    command.add_option("--set", request->set, "override a key; may be repeated")->take_all()->expected(1);
    command.add_option("--method", request->method, "sdem, bpm, rigid_dem or mpm")->required();
    command.add_option("--threads", request->threads, "most threads to use")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    command.add_option("--warm-up", request->warm_up, "steps before those that are measured")
        ->check(CLI::Range(1, 1000000000))
        ->capture_default_str();
    command.add_option("--steps", request->steps, "steps that are measured")
        ->check(CLI::Range(1, 1000000000))
        ->required();
    command.callback([&chosen, request] {
        chosen = [request] {
            install_stop_signals();
            fmt::print("{}\n", to_json(measure_steps(*request)));
            return 0;
        };
    });
}

void add_scaling(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command =
        add(bench, "scaling", "cost and memory of a grain over the number of grains, and where the time goes",
            "--method sdem,rigid_dem --most-grains 100000 --out results/bench_scaling");
    const auto request = std::make_shared<ScalingRequest>();
    const auto quick = std::make_shared<bool>(false);
    command.add_option("--plan", request->plan, "what to run (TOML); bench/scaling/plan.toml if not given");
    command.add_flag("--quick", *quick, "bench/scaling/quick.toml instead, a few seconds");
    command.add_option("--method", request->methods, "only these of the plan, comma separated")
        ->delimiter(',');
    command.add_option("--most-grains", request->most_grains, "leave larger numbers of grains out")
        ->check(CLI::Range(1, 1000000000))
        ->capture_default_str();
    command.add_option("--most-seconds", request->most_seconds, "of a run; longer ones are not begun")
        ->check(CLI::Range(1.0, 1e9))
        ->capture_default_str();
    command.add_option("--repeats", request->repeats, "of every run; times are medians")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_flag("--packings-only", request->packings_only, "make the packings and stop");
    command.add_option("--out", request->folder, "folder for the results")
        ->default_val("results/bench_scaling");
    command.add_flag("--force", request->force, "replace results that are in the folder");
    command.callback([&chosen, request, quick] {
        chosen = [request, quick] {
            if (request->plan.empty())
                request->plan = *quick ? "bench/scaling/quick.toml" : "bench/scaling/plan.toml";
            install_stop_signals();
            return bench_scaling(*request);
        };
    });
}

void add_peers(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command = add(bench, "peers", "other programs beside ours, as far as they are installed",
                            "--peer LAMMPS,Yade --out results/bench_peers");
    const auto request = std::make_shared<PeersRequest>();
    const auto quick = std::make_shared<bool>(false);
    command.add_option("--plan", request->plan, "what to run (TOML); bench/peers/plan.toml if not given");
    command.add_flag("--quick", *quick, "bench/peers/quick.toml instead, a few seconds");
    command.add_option("--peer", request->peers, "only these of the plan, comma separated")->delimiter(',');
    command.add_option("--repeats", request->repeats, "of every run; times and ratios are medians")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_option("--out", request->folder, "folder for the results")
        ->default_val("results/bench_peers");
    command.add_flag("--force", request->force, "replace results that are in the folder");
    command.callback([&chosen, request, quick] {
        chosen = [request, quick] {
            if (request->plan.empty())
                request->plan = *quick ? "bench/peers/quick.toml" : "bench/peers/plan.toml";
            install_stop_signals();
            return bench_peers(*request);
        };
    });
}

}  // namespace

void add_commands(CLI::App& bench, std::function<int()>& chosen) {
    add_steps(bench, chosen);
    add_scaling(bench, chosen);
    add_peers(bench, chosen);
}

}  // namespace softgrain::bench
