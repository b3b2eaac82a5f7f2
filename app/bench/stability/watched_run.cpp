#include "app/bench/stability/watched_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/bench/stability/finite_files.hpp"
#include "app/methods.hpp"
#include "app/run_folder.hpp"
#include "common/errors.hpp"
#include "common/io/history_csv.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 9> names{"done", "refused",    "diverged", "stopped",   "crashed",
                                                "hung", "not finite", "unclear",  "other exit"};
constexpr int asked_to_end = 128 + 15;  // exit code after SIGTERM

Ending ending_of(const ChildEnd& end) {
    if (end.asked_to_end) return end.exit_code == asked_to_end ? Ending::stopped : Ending::hung;
    if (end.signal != 0) return Ending::crashed;
    switch (end.exit_code) {
        case 0:
            return Ending::done;
        case 2:
            return Ending::refused;
        case 3:
            return Ending::diverged;
        default:
            return Ending::other_exit;
    }
}

/// A reason that a reader can do something with: one line, or for a scenario one line for each error.
bool is_clear(const std::string& reason, Ending ending) {
    if (ending != Ending::refused && ending != Ending::diverged) return true;
    return reason.size() > 10 && (ending == Ending::refused || reason.find('\n') == std::string::npos);
}

/// Without the folder in which the bench runs, which says nothing to others.
std::string without_here(std::string text) {
    const std::string here = fs::current_path().string() + "/";
    for (std::size_t at = 0; (at = text.find(here, at)) != std::string::npos;) text.erase(at, here.size());
    return text;
}

/// What the run says of itself, and whether its files are sound.
void look_at_files(WatchedRun& run, const fs::path& folder, const Method& method) {
    try {
        if (fs::exists(folder / "run.json")) {
            const RunReport report = read_report(folder);
            run.steps = report.steps;
            run.reason = report.ended;
            if (report.exit_code != run.exit_code) run.ending = Ending::other_exit;
        }
        if (const auto bad = not_finite_in_run(folder, method)) {
            run.ending = Ending::not_finite;
            run.reason = *bad;
        }
        const History history = read_history(folder / "history.csv");
        if (history.rows() > 0)
            for (const auto& [column, values] : history.columns) run.last[column] = values.back();
    } catch (const InputError& error) {
        if (is_failure(run.ending)) return;  // a crash may leave anything
        run.ending = Ending::other_exit;
        run.reason = error.what();
    }
}

}  // namespace

std::string_view name_of(Ending ending) {
    return names[static_cast<std::size_t>(ending)];
}

bool is_failure(Ending ending) {
    return ending >= Ending::crashed;
}

WatchedRun watch_run(const RunToWatch& what, const fs::path& folder, const ChildLimits& limits) {
    fs::remove_all(folder);
    std::vector<std::string> command{fs::read_symlink("/proc/self/exe").string(),
                                     "run",
                                     what.scenario.string(),
                                     "--method",
                                     what.method,
                                     "--threads",
                                     "1",
                                     "--quiet",
                                     "--out",
                                     folder.string()};
    for (const std::string& one : what.set) command.insert(command.end(), {"--set", one});
    const ChildEnd end = run_child(command, ChildOutput::read, limits);
    WatchedRun run{ending_of(end), end.exit_code, end.messages, 0, end.cpu_time};
    if (end.signal != 0) run.reason = fmt::format("signal {} {}", end.signal, end.messages);
    if (fs::exists(folder)) look_at_files(run, folder, find_method(what.method));
    run.reason = without_here(run.reason);
    if (!is_clear(run.reason, run.ending)) run.ending = Ending::unclear;
    if (!is_failure(run.ending)) fs::remove_all(folder);
    return run;
}

}  // namespace softgrain::bench
