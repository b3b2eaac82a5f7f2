// The command line: reads arguments, calls one function for each command, turns errors into exit codes.
#include <fmt/format.h>
#include <omp.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "app/bench/commands.hpp"
#include "app/calibrate.hpp"
#include "app/compare.hpp"
#include "app/memory.hpp"
#include "app/methods.hpp"
#include "app/probe_fan.hpp"
#include "app/process.hpp"
#include "app/report/curves.hpp"
#include "app/run_folder.hpp"
#include "common/errors.hpp"
#include "common/io/history_csv.hpp"
#include "common/observables/observable.hpp"
#include "common/packing/make_packing.hpp"
#include "common/stop.hpp"
#include "version.hpp"
#include "viz/client.hpp"
#include "viz/plot_text.hpp"

namespace softgrain {
namespace {

struct Arguments {
    std::string scenario;
    std::string method;
    std::vector<std::string> compared;
    std::string out;
    std::string reference;
    std::vector<double> at;
    std::vector<std::string> set;
    std::vector<std::string> rest;
    double plateau = 0.0, modulus = 0.0;
    int seeds = 5;
    int directions = 12;
    int threads = 0;
    double checkpoint_period = 60.0;
    std::uint64_t memory = 0;
    bool allow_outside = false;
    bool calibrate = false;
    bool resume = false, force = false, quiet = false, no_pictures = false, keys = false;
};

Scenario scenario_of(const Arguments& a) {
    return read_scenario(a.scenario, a.set, method_keys(),
                         a.allow_outside ? NamedFiles::anywhere : NamedFiles::inside);
}

void print_warnings(const RunReport& report) {
    for (const std::string& warning : report.warnings) fmt::print(stderr, "warning: {}\n", warning);
}

int run_command(const Arguments& a) {
    const Method& method = find_method(a.method);
    const Scenario scenario = scenario_of(a);
    check_memory(scenario, method, a.memory);
    const Packing packing = make_packing(scenario);
    install_stop_signals();
    const RunReport report = run_into_folder({.scenario = scenario,
                                              .packing = packing,
                                              .method = method,
                                              .folder = a.out,
                                              .threads = a.threads,
                                              .resume = a.resume,
                                              .force = a.force,
                                              .checkpoint_period = a.checkpoint_period,
                                              .quiet = a.quiet});
    if (!report.has_results) {
        fmt::print(stderr, "{}: {}\n", report.method, report.ended);
        return report.exit_code;
    }
    fmt::print("{}: {}\n{} steps, {:.2f} s wall, {:.2f} s CPU, results in {}\n", report.method, report.ended,
               report.steps, report.wall_time, report.cpu_time, a.out);
    print_warnings(report);
    return report.exit_code;
}

int compare_command(const Arguments& a) {
    const Scenario scenario = scenario_of(a);
    std::vector<std::string> chosen = a.compared;
    if (chosen.empty())
        for (const Method& m : methods()) chosen.emplace_back(m.name);
    for (const std::string& name : chosen) check_memory(scenario, find_method(name), a.memory);
    install_stop_signals();
    return compare({.scenario = scenario,
                    .methods = chosen,
                    .folder = a.out,
                    .reference = a.reference,
                    .at = a.at,
                    .threads = a.threads,
                    .calibrate = a.calibrate,
                    .resume = a.resume,
                    .force = a.force,
                    .pictures = !a.no_pictures,
                    .quiet = a.quiet});
}

int fan_command(const Arguments& a) {
    const Scenario scenario = scenario_of(a);
    for (const std::string& name : a.compared) check_memory(scenario, find_method(name), a.memory);
    install_stop_signals();
    return probe_fan({.scenario = scenario,
                      .methods = a.compared,
                      .folder = a.out,
                      .directions = a.directions,
                      .threads = a.threads,
                      .resume = a.resume,
                      .force = a.force,
                      .pictures = !a.no_pictures,
                      .quiet = a.quiet});
}

int calibrate_command(const Arguments& a) {
    const Scenario scenario = scenario_of(a);
    const bool by_plateau = a.plateau > 0.0;
    return calibrate({.scenario = scenario,
                      .property = by_plateau ? bpm::GrainProperty::plateau : bpm::GrainProperty::modulus,
                      .asked = by_plateau ? a.plateau : a.modulus,
                      .seeds = a.seeds,
                      .threads = a.threads,
                      .curve = a.out});
}

int validate_command(const Arguments& a) {
    const Scenario scenario = scenario_of(a);
    for (const Method& m : methods()) scenario_for(scenario, m);
    fmt::print("{}: valid\n", a.scenario);
    return 0;
}

int list_command(const Arguments& a) {
    if (a.keys) {
        fmt::print("{}", describe_keys(method_keys()));
        return 0;
    }
    fmt::print("Methods\n");
    for (const Method& m : methods())
        fmt::print("  {:<10} {}{}\n", m.name, m.title,
                   m.not_given.empty() ? "" : fmt::format(" (does not give: {})", m.not_given));
    fmt::print("\n{:<50}", "Features");
    for (const Method& m : methods()) fmt::print(" {:>10}", m.name);
    fmt::print("\n");
    for (const FeatureRow& row : feature_rows()) {
        fmt::print("  {:<48}", row.title);
        for (const Method& m : methods()) fmt::print(" {:>10}", has_feature(m.refusals, row) ? "yes" : "-");
        fmt::print("\n");
    }
    fmt::print("\nHistory columns\n");
    for (const Observable& o : observables())
        fmt::print("  {:<32} {}\n", o.name, o.unit.empty() ? "-" : o.unit);
    fmt::print("\nScenario keys: softgrain list --keys\n");
    return 0;
}

int info_command(const Arguments& a) {
    const RunReport r = read_report(a.out);
    const History history = read_history(std::filesystem::path(a.out) / "history.csv");
    fmt::print(
        "method       {}\nended        {}\ngrains       {}\nsteps        {}\nsimulated    {:.6g} s\nwall "
        "time    "
        "{:.2f} s\nCPU time     {:.2f} s\npeak memory  {:.1f} MB\nsamples      {}\n"
        "state hash   {}\n",
        r.method, r.ended, r.grains, r.steps, r.simulated_time, r.wall_time, r.cpu_time, r.peak_memory / 1e6,
        history.rows(), r.last_state_hash.empty() ? "unknown" : r.last_state_hash);
    print_warnings(r);
    if (history.rows() == 0) return 0;
    fmt::print("\n{:<32} {:>14} {:>14}\n", "", "first", "last");
    for (const Observable& o : observables()) {
        const auto& values = history.column(o.name);
        fmt::print("{:<32} {:>14.6g} {:>14.6g} {}\n", o.name, values.front(), values.back(), o.unit);
    }
    fmt::print("\n{}", plot_text(report::curve_plot("", {{r, history}}, std::nullopt, "mean_stress",
                                                    "mean stress [N/m]", false)));
    return 0;
}

/// Drawing lives in an executable of its own.
int render_command(const Arguments& a) {
    const std::string program = find_renderer().string();
    if (program.empty())
        throw OutputError("softgrain-render is not beside this program; build or install it");
    become(program, a.rest);
}

void scenario_options(CLI::App& command, Arguments& a) {
    command.add_option("scenario", a.scenario, "scenario file (TOML)")->required();
    command
        .add_option("--set", a.set, "override a key, e.g. --set material.poisson_ratio=0.45; may be repeated")
        ->take_all()
        ->expected(1);
    command.add_flag("--allow-outside", a.allow_outside,
                     "let packing.path lead out of the scenario's folder and the current one with ..");
}

/// A finite number > 0.
std::string not_positive(const std::string& text) {
    double value = 0.0;
    const bool is_number = CLI::detail::lexical_cast(text, value);
    return is_number && value > 0.0 && std::isfinite(value)
               ? ""
               : fmt::format("must be a number > 0, got {}", text);
}

void thread_option(CLI::App& command, Arguments& a) {
    command.add_option("--threads", a.threads, "most threads to use; the results do not depend on it")
        ->default_val(omp_get_num_procs())
        ->check(CLI::Range(1, 1024));
}

void calibrate_options(CLI::App& command, Arguments& a) {
    scenario_options(command, a);
    thread_option(command, a);
    CLI::Option_group* wanted = command.add_option_group("wanted", "one of them");
    wanted->add_option("--plateau", a.plateau, "stress at which one grain between two walls yields [N/m]")
        ->check(not_positive);
    wanted->add_option("--modulus", a.modulus, "initial modulus of one grain between two walls [N/m]")
        ->check(not_positive);
    wanted->require_option(1);
    command.add_option("--seeds", a.seeds, "grains to measure, and as many again to check")
        ->check(CLI::Range(2, 1000))
        ->capture_default_str();
    command.add_option("--out", a.out, "CSV file for the curves of the check");
}

void run_options(CLI::App& command, Arguments& a) {
    scenario_options(command, a);
    thread_option(command, a);
    command.add_option("--out", a.out, "folder for the results")->required();
    command.add_flag("--resume", a.resume, "go on from the last checkpoint in the folder");
    command.add_flag("--force", a.force, "replace results that are in the folder");
    command.add_flag("--quiet", a.quiet, "no progress");
    command
        .add_option("--memory", a.memory,
                    "most memory that a run may need by estimate, e.g. 20G or 500M; what the machine has if "
                    "not given")
        ->transform(CLI::AsSizeValue(true));
}

int command_line(int argc, char** argv) {
    Arguments a;
    CLI::App app{"softgrain: the same compaction through several models of soft grains", "softgrain"};
    app.set_version_flag("--version", fmt::format("softgrain {} ({})", version, commit));
    app.require_subcommand(1);
    int (*chosen)(const Arguments&) = nullptr;
    const auto add = [&](const char* name, const char* help, int (*function)(const Arguments&),
                         const char* example) {
        CLI::App* command = app.add_subcommand(name, help);
        command->footer(fmt::format("Example:\n  softgrain {}", example));
        command->callback([&chosen, function] { chosen = function; });
        return command;
    };

    CLI::App* run = add("run", "run a scenario with one method", run_command,
                        "run scenarios/default.toml --method sdem --out results/sdem");
    run_options(*run, a);
    run->add_option("--method", a.method, "sdem, bpm, rigid_dem or mpm")->required();
    run->add_option("--checkpoint-period", a.checkpoint_period, "wall time between two checkpoints [s]")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();

    CLI::App* compare_app =
        add("compare", "run a scenario with several methods from one initial packing", compare_command,
            "compare scenarios/default.toml --methods sdem,bpm --out results/default");
    run_options(*compare_app, a);
    compare_app->add_option("--methods", a.compared, "comma separated; all methods if not given")
        ->delimiter(',');
    compare_app->add_option("--reference", a.reference,
                            "CSV of a curve to show beside the methods and to measure errors against");
    compare_app->add_option("--at", a.at, "packing fractions of the table, comma separated")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1.0));
    compare_app->add_flag(
        "--calibrate", a.calibrate,
        "choose bpm.attraction_stress so that aggregates yield at material.yield_stress, or "
        "at 0.05 E if it is not given");
    compare_app->add_flag("--no-pictures", a.no_pictures,
                          "no pictures and plots as SVG only, also in report.html");

    CLI::App* fan = add("fan", "probe one state in many directions and draw the response envelope",
                        fan_command, "fan scenarios/probes/fan.toml --methods rigid_dem --out results/fan");
    run_options(*fan, a);
    fan->add_option("--methods", a.compared, "comma separated")->delimiter(',')->required();
    fan->add_option("--directions", a.directions, "of the probes, evenly round the circle")
        ->check(CLI::Range(4, 360))
        ->capture_default_str();
    fan->add_flag("--no-pictures", a.no_pictures, "numbers only");

    calibrate_options(*add("calibrate", "find the attraction that gives aggregates (bpm) a wanted strength",
                           calibrate_command, "calibrate scenarios/default.toml --plateau 0.05"),
                      a);
    scenario_options(*add("validate", "check a scenario file and say all that is wrong with it",
                          validate_command, "validate my_scenario.toml"),
                     a);
    std::function<int()> chosen_bench;
    bench::add_commands(*app.add_subcommand("bench", "measure the methods"), chosen_bench);

    add("list", "methods, history columns and scenario keys", list_command, "list --keys")
        ->add_flag("--keys", a.keys, "every key of a scenario file with type, default, range and meaning");
    add("info", "what a results folder holds", info_command, "info results/default/sdem")
        ->add_option("folder", a.out, "results folder of one run")
        ->required();
    CLI::App* render =
        add("render", "draw runs side by side, as pictures or a film (options: softgrain render --help)",
            render_command, "render results/default --film");
    render->prefix_command();
    render->set_help_flag();
    render->callback([&] {
        a.rest = render->remaining();
        chosen = render_command;
    });

    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    return chosen_bench ? chosen_bench() : chosen(a);
}

}  // namespace
}  // namespace softgrain

int main(int argc, char** argv) {
    try {
        return softgrain::command_line(argc, argv);
    } catch (const softgrain::InputError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 2;
    } catch (const softgrain::DivergedError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 3;
    } catch (const softgrain::OutputError& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 4;
    } catch (const softgrain::StopAsked& stopped) {
        fmt::print(stderr, "{}\n", stopped.what());
        return 128 + softgrain::stop_signal();
    } catch (const std::filesystem::filesystem_error& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 4;
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "not enough memory for this scenario\n");
        return 4;
    }
}
