#include "app/bench/commands.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/bench/bench_error.hpp"
#include "app/bench/peers/bench_peers.hpp"
#include "app/bench/scaling/bench_scaling.hpp"
#include "app/bench/scaling/steps.hpp"
#include "app/bench/stability/bench_stability.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

CLI::App& add(CLI::App& bench, const char* name, const char* help, const char* example) {
    CLI::App& command = *bench.add_subcommand(name, help);
    command.footer(fmt::format("Example:\n  softgrain bench {} {}", name, example));
    return command;
}

/// --plan and --quick; the path of the plan that they ask for, once they are parsed.
std::function<std::filesystem::path()> plan_options(CLI::App& command, const std::string& folder) {
    const auto plan = std::make_shared<std::filesystem::path>();
    const auto quick = std::make_shared<bool>(false);
    command.add_option("--plan", *plan, fmt::format("what to run (TOML); {}/plan.toml if not given", folder));
    command.add_flag("--quick", *quick, fmt::format("{}/quick.toml instead, a few seconds", folder));
    return [plan, quick, folder] {
        const std::filesystem::path own = folder;
        return !plan->empty() ? *plan : *quick ? own / "quick.toml" : own / "plan.toml";
    };
}

void add_error(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command = add(bench, "error", "error against cost for every method and setting of a plan",
                            "--case four_walls --out results/bench_error");
    const auto request = std::make_shared<ErrorRequest>();
    const auto plan = plan_options(command, "bench/error");
    command.add_option("--case", request->cases, "only these cases, comma separated")->delimiter(',');
    command.add_option("--method", request->methods, "only these methods, comma separated")->delimiter(',');
    command.add_option("--repeats", request->repeats, "of every run; CPU times are medians")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_option("--repeat-below", request->repeat_below, "[s] runs of more CPU time are not repeated")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    command.add_option("--out", request->folder, "folder for the results")
        ->default_val("results/bench_error");
    command.add_flag("--resume", request->resume, "keep the runs in the folder that are finished");
    command.add_flag("--force", request->force, "replace results that are in the folder");
    command.callback([&chosen, request, plan] {
        chosen = [request, plan] {
            request->plan = plan();
            install_stop_signals();
            return bench_error(*request);
        };
    });
}

void add_stability(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command = add(bench, "stability", "stable time steps, long runs, extreme and random scenarios",
                            "--part map --method sdem");
    const auto request = std::make_shared<StabilityRequest>();
    const auto plan = plan_options(command, "bench/stability");
    command
        .add_option("--part", request->parts, "only these of random, extremes, map, long, comma separated")
        ->delimiter(',')
        ->check(CLI::IsMember({"random", "extremes", "map", "long"}));
    command.add_option("--method", request->methods, "only these methods, comma separated")->delimiter(',');
    command.add_option("--out", request->folder, "folder for the results")
        ->default_val("results/bench_stability");
    command.add_flag("--force", request->force, "replace results that are in the folder");
    command.callback([&chosen, request, plan] {
        chosen = [request, plan] {
            request->plan = plan();
            install_stop_signals();
            return bench_stability(*request);
        };
    });
}

/// A script of the source tree, as it builds the program with and without features.
void add_skip(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command =
        add(bench, "skip", "instructions that options cost, unused and used, and that skipping saves",
            "unused saved");
    const auto tables = std::make_shared<std::vector<std::string>>();
    command.add_option("table", *tables, "what to count; all if none is named")
        ->check(CLI::IsMember({"unused", "used", "saved", "written"}));
    command.callback([&chosen, tables] {
        chosen = [tables]() -> int {
            const std::string script = "bench/skip/skip.py";
            if (!std::filesystem::exists(script))
                throw InputError(fmt::format(
                    "{}: not here; bench skip builds softgrain anew, start it in its source tree", script));
            become(script, *tables);
        };
    });
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
    const auto plan = plan_options(command, "bench/scaling");
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
    command.callback([&chosen, request, plan] {
        chosen = [request, plan] {
            request->plan = plan();
            install_stop_signals();
            return bench_scaling(*request);
        };
    });
}

void add_peers(CLI::App& bench, std::function<int()>& chosen) {
    CLI::App& command = add(bench, "peers", "other programs beside ours, as far as they are installed",
                            "--peer LAMMPS,Yade --out results/bench_peers");
    const auto request = std::make_shared<PeersRequest>();
    const auto plan = plan_options(command, "bench/peers");
    command.add_option("--peer", request->peers, "only these of the plan, comma separated")->delimiter(',');
    command.add_option("--repeats", request->repeats, "of every run; times and ratios are medians")
        ->check(CLI::Range(1, 100))
        ->capture_default_str();
    command.add_option("--out", request->folder, "folder for the results")
        ->default_val("results/bench_peers");
    command.add_flag("--force", request->force, "replace results that are in the folder");
    command.callback([&chosen, request, plan] {
        chosen = [request, plan] {
            request->plan = plan();
            install_stop_signals();
            return bench_peers(*request);
        };
    });
}

}  // namespace

void add_commands(CLI::App& bench, std::function<int()>& chosen) {
    bench.require_subcommand(1);
    add_error(bench, chosen);
    add_stability(bench, chosen);
    add_skip(bench, chosen);
    add_steps(bench, chosen);
    add_scaling(bench, chosen);
    add_peers(bench, chosen);
}

}  // namespace softgrain::bench
