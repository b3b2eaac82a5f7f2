#include "app/bench/runner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/run_program.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

struct Job {
    Measurement measurement;
    std::vector<std::string> set;  ///< of the case and of the setting
    std::string scenario;          ///< resolved, as a run writes it
    fs::path folder;
};

std::string folder_name(const Setting& setting) {
    std::string name = setting.method;
    for (const std::string& one : setting.set) name += "_" + one;
    for (char& c : name)
        if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '.' && c != '=' && c != '-' && c != '+')
            c = '_';
    return name;
}

std::vector<Job> jobs_of(const Plan& plan, const fs::path& folder) {
    std::vector<Job> jobs;
    for (const Case& one : plan.cases) {
        if (!one.truth) continue;
        for (const Setting& setting : plan.settings) {
            if (!setting.is_for(one)) continue;
            Job job{{&one, &setting, {}, {}}, one.set, {}, folder / "runs" / one.name / folder_name(setting)};
            job.set.insert(job.set.end(), setting.set.begin(), setting.set.end());
            try {
                job.scenario =
                    write_scenario(read_scenario(one.scenario, job.set, method_keys()), method_keys());
            } catch (const InputError& error) {
                throw InputError(fmt::format("{}:{}: knob \"{}\" on case {}: {}", plan.source.string(),
                                             setting.line, setting.knob, one.name, error.what()));
            }
            jobs.push_back(std::move(job));
        }
    }
    return jobs;
}

std::string content(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The run that is in the folder, if it was not stopped and is of this job.
std::optional<RunReport> finished_run(const fs::path& folder, const Job& job) {
    if (!fs::exists(folder / "run.json") || !says_the_same(content(folder / "scenario.toml"), job.scenario,
                                                           method_keys(), job.measurement.setting->method))
        return std::nullopt;
    RunReport report = read_report(folder);
    return report.exit_code < 128 ? std::optional(report) : std::nullopt;
}

/// Only what a bench reads again.
void tidy(const fs::path& folder) {
    std::vector<fs::path> others;
    for (const auto& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        if (name != "run.json" && name != "scenario.toml" && name != "history.csv")
            others.push_back(entry.path());
    }
    for (const fs::path& path : others) fs::remove_all(path);
}

RunReport run_once(const Job& job, const fs::path& folder) {
    fs::remove_all(folder);
    std::vector<std::string> command{fs::read_symlink("/proc/self/exe").string(),
                                     "run",
                                     job.measurement.of->scenario.string(),
                                     "--method",
                                     job.measurement.setting->method,
                                     "--threads",
                                     "1",
                                     "--quiet",
                                     "--out",
                                     folder.string()};
    for (const std::string& one : job.set) command.insert(command.end(), {"--set", one});
    const auto failure = run_program(command, ChildOutput::read);
    if (fs::exists(folder / "run.json")) {
        tidy(folder);
        return read_report(folder);
    }
    RunReport refused;
    refused.method = job.measurement.setting->method;
    refused.exit_code = 2;
    refused.ended = failure.value_or("left no run.json");
    refused.ended.resize(std::min(refused.ended.find('\n'), refused.ended.size()));
    if (const std::string begin = refused.method + ": "; refused.ended.starts_with(begin))
        refused.ended.erase(0, begin.size());
    return refused;
}

}  // namespace

std::string_view ended_in_short(const RunReport& report) {
    return std::string_view(report.ended).substr(0, report.ended.find(':'));
}

std::vector<Measurement> run_plan(const Plan& plan, const RunnerOptions& options) {
    std::vector<Job> jobs = jobs_of(plan, options.folder);
    // A packing of discs that an earlier run prepared would make later ones cheaper.
    ::setenv("SOFTGRAIN_CACHE", "off", 1);
    const std::size_t all = jobs.size() * static_cast<std::size_t>(options.repeats);
    std::size_t number = 0;
    for (int repeat = 1; repeat <= options.repeats; ++repeat)
        for (Job& job : jobs) {
            if (stop_signal() != 0) break;
            ++number;
            Measurement& measurement = job.measurement;
            if (repeat > 1 && measurement.repeats.front().cpu_time > options.repeat_below) continue;
            const fs::path folder = job.folder / fmt::format("{}", repeat);
            const auto earlier = options.resume ? finished_run(folder, job) : std::nullopt;
            measurement.repeats.push_back(earlier ? *earlier : run_once(job, folder));
            const RunReport& report = measurement.repeats.back();
            if (earlier) continue;
            fmt::print("{}/{} {} {}, {}: {:.2f} s, {}\n", number, all, measurement.of->name, report.method,
                       measurement.setting->name(), report.cpu_time, ended_in_short(report));
            std::fflush(stdout);
        }
    std::vector<Measurement> measured;
    for (Job& job : jobs) {
        if (!job.measurement.repeats.empty() && job.measurement.repeats.front().steps > 0)
            job.measurement.history = read_history(job.folder / "1" / "history.csv");
        measured.push_back(std::move(job.measurement));
    }
    return measured;
}

}  // namespace softgrain::bench
