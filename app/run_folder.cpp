#include "app/run_folder.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/methods.hpp"
#include "app/process.hpp"
#include "app/progress.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/io/checkpoint_ring.hpp"
#include "common/io/folder_lock.hpp"
#include "common/io/history_csv.hpp"
#include "common/io/measure_files.hpp"
#include "common/stop.hpp"
#include "common/time_loop.hpp"
#include "version.hpp"
#include "viz/paraview/view_script.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

using nlohmann::json;

struct Clocks {
    double wall = wall_clock();
    double cpu = cpu_clock();
};

/// As 16 hexadecimal digits each.
std::vector<std::string> in_digits(const std::vector<std::int64_t>& hashes) {
    std::vector<std::string> digits;
    for (const std::int64_t hash : hashes)
        digits.push_back(fmt::format("{:016x}", static_cast<std::uint64_t>(hash)));
    return digits;
}

void write_report(const RunRequest& request, const RunReport& report, const RunState& state) {
    const json text{
        {"version", report.version},
        {"commit", report.commit},
        {"method", report.method},
        {"scenario", request.scenario.source.string()},
        {"title", request.scenario.title},
        {"seed", request.scenario.seed},
        {"threads", report.threads},
        {"processor", report.processor},
        {"finished", report.finished},
        {"ended", report.ended},
        {"exit_code", report.exit_code},
        {"grains", report.grains},
        {"steps", report.steps},
        {"simulated_time", report.simulated_time},
        {"time_step", report.steps > 0 ? report.simulated_time / static_cast<double>(report.steps) : 0.0},
        {"wall_time", report.wall_time},
        {"cpu_time", report.cpu_time},
        {"peak_memory", report.peak_memory},
        {"samples", state.history.size()},
        {"frames", state.frame_times.size()},
        {"warnings", report.warnings},
        {"state_hashes", in_digits(state.state_hashes)},
    };
    write_file_atomically(request.folder / "run.json", text.dump(2) + "\n");
}

/// The last checkpoint of an unfinished or finished run of the same scenario, or nothing.
std::optional<RunFile> earlier_run(const RunRequest& request, const std::string& scenario_text) {
    if (!request.resume) {
        if (!request.force) refuse_to_overwrite(request.folder);
        return std::nullopt;
    }
    if (!has_checkpoint(request.folder)) return std::nullopt;  // stopped before its first one
    FoundCheckpoint found = read_checkpoint(request.folder);
    if (found.file.method != request.method.name ||
        !says_the_same(found.file.scenario, scenario_text, method_keys(), request.method.name))
        throw InputError(fmt::format(
            "{}: was made by another {}; --resume needs the same scenario and overrides (compare with {})",
            found.path.string(), found.file.method != request.method.name ? "method" : "scenario",
            (request.folder / "scenario.toml").string()));
    if (!found.said.empty()) {
        fmt::print(stderr, "{}; going on from {}, step {}\n", found.said, found.path.filename().string(),
                   found.file.state.step);
        put_damaged_checkpoint_aside(request.folder);
    }
    return std::move(found.file);
}

/// What an earlier run left must not be taken for this one's.
void remove_results(const std::filesystem::path& folder) {
    std::filesystem::remove(folder / "run.json");
    for (const char* not_always_written : {"contacts.pvd", "parts.pvd", "part_contacts.pvd"})
        std::filesystem::remove(folder / not_always_written);
    std::filesystem::remove_all(folder / "measures");
    remove_checkpoints(folder);
}

}  // namespace

void refuse_to_overwrite(const std::filesystem::path& folder) {
    if (!has_checkpoint(folder) && !std::filesystem::exists(folder / "history.csv")) return;
    throw InputError(
        fmt::format("{}: holds results already; go on with --resume, replace them with --force, or choose "
                    "another --out",
                    folder.string()));
}

RunReport run_into_folder(const RunRequest& request) {
    const Scenario scenario = scenario_for(request.scenario, request.method);
    const std::string scenario_text = write_scenario(request.scenario, method_keys());
    const bool folder_is_new = !std::filesystem::exists(request.folder);
    make_directories(request.folder);
    const FolderLock lock(request.folder);
    std::optional<RunFile> earlier = earlier_run(request, scenario_text);
    RunReport report;
    report.method = request.method.name;
    report.grains = request.packing.size();
    report.version = version;
    report.commit = commit;
    report.threads = request.threads;
    report.processor = processor_name();
    report.finished = date_and_time();

    omp_set_num_threads(request.threads);
    reset_peak_memory();
    const Clocks begin;
    std::unique_ptr<Solver> solver;
    const auto without_results = [&](int exit_code, std::string ended) {
        report.exit_code = exit_code;
        report.has_results = false;
        report.ended = std::move(ended);
        if (folder_is_new) std::filesystem::remove(request.folder);
        return report;
    };
    try {
        solver = request.method.make(scenario, request.packing);
    } catch (const InputError& error) {
        return without_results(2, fmt::format("cannot run this scenario: {}", error.what()));
    } catch (const DivergedError& error) {
        return without_results(3, fmt::format("cannot prepare the grains: {}", error.what()));
    } catch (const StopAsked& stopped) {
        return without_results(
            128 + stop_signal(),
            fmt::format("{} while the grains were prepared; nothing was written", stopped.what()));
    }

    RunFile file{version, std::string(request.method.name), scenario_text, {}, {}, 0.0, 0.0};
    std::optional<RunFile> before;
    if (earlier) {
        file = std::move(*earlier);
        solver->load(file.solver);
    } else {
        if (!request.from.empty()) {
            before = read_checkpoint(request.from).file;
            solver->load(before->solver);
        }
        remove_results(request.folder);
        write_file_atomically(request.folder / "scenario.toml", scenario_text);
    }

    write_view_script(request.folder, {"."});
    HistoryWriter history(request.folder / "history.csv", file.state.history);
    GrainWriter grains(request.folder, grain_data(request.packing.size(), scenario.sampling.outlines),
                       request.packing.grain_class);
    ContactWriter contacts(request.folder);
    WallWriter walls(request.folder);
    PartWriter parts(request.folder, scenario.sampling.contacts);
    std::vector<Observer*> observers{&history, &grains, &walls};
    if (scenario.sampling.contacts) observers.push_back(&contacts);
    if (scenario.sampling.parts) observers.push_back(&parts);
    std::optional<MeasureWriter> measures;
    std::vector<std::string> measured = scenario.sampling.measures;
    measured.insert(measured.end(), request.measures.begin(), request.measures.end());
    if (!measured.empty()) observers.push_back(&measures.emplace(request.folder, measured));

    TimeLoop run(scenario, request.packing, *solver, observers);
    std::vector<std::string> lost;
    if (earlier) lost = run.resume(file.state);
    for (const std::string& line : lost) fmt::print(stderr, "{}\n", line);
    if (before) run.branch(before->state);
    const double wall_before = file.wall_time;
    const double cpu_before = file.cpu_time;
    const auto checkpoint = [&] {
        file.state = run.state();
        file.solver = {};
        solver->save(file.solver);
        file.wall_time = wall_before + wall_clock() - begin.wall;
        file.cpu_time = cpu_before + cpu_clock() - begin.cpu;
        write_checkpoint(request.folder, file);
    };

    Progress progress(std::string(request.method.name), stderr_is_terminal());
    double next_checkpoint = begin.wall + request.checkpoint_period;
    try {
        if (!run.finished())
            run.go(stop_signal(), [&] {
                if (!request.quiet) progress.update(run);
                if (wall_clock() < next_checkpoint) return;
                checkpoint();
                next_checkpoint = wall_clock() + request.checkpoint_period;
            });
        checkpoint();
        report.ended = run.state().ended;
        if (!run.finished()) {
            report.exit_code = 128 + stop_signal().load();
            report.ended = "stopped by a signal; go on with --resume";
        }
    } catch (const DivergedError& error) {
        report.exit_code = 3;
        report.ended = error.what();
    } catch (
        const InputError& error) {  // known only once the run is there, as a stage that begins beyond its end
        report.exit_code = 2;
        report.ended = error.what();
    }
    if (!request.quiet) progress.finish(run);
    report.steps = run.state().step;
    report.simulated_time = run.state().time;
    report.wall_time = wall_before + wall_clock() - begin.wall;
    report.cpu_time = cpu_before + cpu_clock() - begin.cpu;
    report.warnings = warnings_of(run.state().watch, scenario.watch);
    report.warnings.insert(report.warnings.end(), lost.begin(), lost.end());
    report.peak_memory = static_cast<double>(peak_memory());
    report.finished = date_and_time();
    write_report(request, report, run.state());
    return report;
}

RunReport read_report(const std::filesystem::path& folder) {
    const auto path = folder / "run.json";
    std::ifstream file(path);
    if (!file) throw InputError(fmt::format("{}: no such run (run.json is missing)", folder.string()));
    try {
        const json text = json::parse(file);
        RunReport report;
        report.method = text.at("method");
        report.ended = text.at("ended");
        report.exit_code = text.at("exit_code");
        report.grains = text.at("grains");
        report.steps = text.at("steps");
        report.simulated_time = text.at("simulated_time");
        report.wall_time = text.at("wall_time");
        report.cpu_time = text.at("cpu_time");
        report.peak_memory = text.at("peak_memory");
        report.version = text.at("version");
        report.commit = text.at("commit");
        report.threads = text.at("threads");
        report.processor = text.value("processor", "");
        report.finished = text.value("finished", "");
        report.warnings = text.value("warnings", std::vector<std::string>());
        const auto hashes = text.value("state_hashes", std::vector<std::string>());
        if (!hashes.empty()) report.last_state_hash = hashes.back();
        return report;
    } catch (const json::exception& error) {
        throw InputError(fmt::format("{}: damaged: {}", path.string(), error.what()));
    }
}

}  // namespace softgrain
