#include "app/bench/scaling/scaling_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "app/bench/rows.hpp"
#include "app/bench/scaling/tiles.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/packing/packing_csv.hpp"
#include "viz/run_program.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;
using Command = std::vector<std::string>;

constexpr double profiled_seconds = 1.0;  // at least, of CPU time

template <class Value>
double median_of(const std::vector<StepsReport>& repeats, Value value) {
    std::vector<double> values;
    for (const StepsReport& one : repeats) values.push_back(value(one));
    return median(values);
}

double grain_steps(const StepsReport& one) {
    return static_cast<double>(one.grains) * static_cast<double>(one.steps);
}

double available_memory() {
    std::ifstream info("/proc/meminfo");
    for (std::string word; info >> word;) {
        if (word != "MemAvailable:") continue;
        double kilobytes = 0.0;
        info >> kilobytes;
        return 1024.0 * kilobytes;
    }
    return 0.0;
}

/// Packings by number of grains; all subjects of a scenario have the same.
class Packings {
  public:
    explicit Packings(fs::path folder) : folder_(std::move(folder)) { make_directories(folder_); }

    /// Overrides that make a scenario start from so many grains.
    Command overrides(const Subject& subject, int count) {
        const fs::path path = folder_ / fmt::format("{}_{}.csv", subject.scenario.stem().string(), count);
        auto at = made_.find(path);
        if (at == made_.end()) {
            const Scenario scenario = read_scenario(subject.scenario, subject.set, method_keys());
            const Packing packing = tiled_packing(scenario, count);
            write_packing_csv(path, packing);
            at = made_
                     .emplace(path, Command{fmt::format("packing.path={}", fs::absolute(path).string()),
                                            fmt::format("box.width={:.17g}", packing.box.width()),
                                            fmt::format("box.height={:.17g}", packing.box.height())})
                     .first;
        }
        return at->second;
    }

  private:
    fs::path folder_;
    std::map<fs::path, Command> made_;
};

Command command_of(const Subject& subject, int threads, int steps, const Command& overrides) {
    Command command{fs::read_symlink("/proc/self/exe").string(),
                    "bench",
                    "steps",
                    subject.scenario.string(),
                    "--method",
                    subject.method,
                    "--threads",
                    fmt::format("{}", threads),
                    "--warm-up",
                    fmt::format("{}", subject.warm_up),
                    "--steps",
                    fmt::format("{}", steps)};
    Command set = subject.set;
    set.insert(set.end(), overrides.begin(), overrides.end());
    for (const std::string& one : set) command.insert(command.end(), {"--set", one});
    return command;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

/// What a run printed after anything else it had to say.
StepsReport report_in(const std::string& said) {
    return steps_report(said.substr(std::min(said.rfind("\n{") + 1, said.size())));
}

void run_once(ScalingPoint& point, Packings& packings) {
    const Command command = command_of(*point.of, point.threads, point.of->steps(point.count),
                                       packings.overrides(*point.of, point.count));
    const ChildEnd end = run_child(command, ChildOutput::read);
    if (const auto failure = failure_of(end, command[0]))
        point.failure = first_line(*failure);
    else
        point.repeats.push_back(report_in(end.messages));
}

/// Of the same subject, a run of as many grains as possible, but fewer; null if there is none.
const StepsReport* largest_below(const ScalingResults& results, const ScalingPoint& point) {
    const StepsReport* largest = nullptr;
    for (const ScalingPoint& other : results.points)
        if (other.of == point.of && other.count < point.count && !other.repeats.empty())
            largest = &other.repeats.front();
    return largest;
}

/// The samples of one run that fell into its measured steps; empty, with the reason, if there are none.
Profile profile_of(const ScalingPoint& measured, Packings& packings, const fs::path& folder,
                   std::string& failure) {
    const fs::path perf = find_on_path("perf");
    if (perf.empty()) {
        failure = "perf is not installed (Debian: apt install linux-perf)";
        return {};
    }
    const std::string data = (folder / "perf.data").string();
    Command record{perf.string(), "record", "-q",   "-e", "cpu-clock", "-F",
                   "997",         "-k",     "mono", "-o", data,        "--"};
    const Subject& subject = *measured.of;
    const int steps = std::max(subject.steps(measured.count),
                               static_cast<int>(profiled_seconds / (measured.cpu() * measured.count)));
    const Command run = command_of(subject, 1, steps, packings.overrides(subject, measured.count));
    record.insert(record.end(), run.begin(), run.end());
    const ChildEnd recorded = run_child(record, ChildOutput::read);
    if (const auto failed = failure_of(recorded, record[0])) {
        failure = "perf record: " + first_line(*failed);
        return {};
    }
    const StepsReport report = report_in(recorded.messages);
    const ChildEnd listed =
        run_child({perf.string(), "report", "-q", "--stdio", "--no-children", "-F", "overhead,sym", "-i",
                   data, "--time", fmt::format("{:.6f},{:.6f}", report.began, report.ended)},
                  ChildOutput::read);
    const auto failed = failure_of(listed, record[0]);
    fs::remove(data);
    if (failed) failure = "perf report: " + first_line(*failed);
    Profile profile = failed ? Profile{} : read_profile(listed.messages);
    if (!failed && profile.empty()) failure = "perf took no samples";
    return profile;
}

}  // namespace

double ScalingPoint::cpu() const {
    return median_of(repeats, [](const StepsReport& one) { return one.cpu / grain_steps(one); });
}

double ScalingPoint::wall() const {
    return median_of(repeats, [](const StepsReport& one) { return one.wall / grain_steps(one); });
}

double ScalingPoint::memory() const {
    return median_of(repeats,
                     [](const StepsReport& one) { return one.memory / static_cast<double>(one.grains); });
}

double ScalingPoint::spread() const {
    const auto [least, most] = std::ranges::minmax(repeats, {}, &StepsReport::cpu);
    return most.cpu / least.cpu;
}

const ScalingPoint* ScalingResults::find(const Subject& subject, int count, int threads) const {
    const auto at = std::ranges::find_if(points, [&](const ScalingPoint& one) {
        return one.of == &subject && one.count == count && one.threads == threads;
    });
    return at == points.end() || at->repeats.empty() ? nullptr : &*at;
}

std::optional<std::string> does_not_fit(const StepsReport& smaller, const Subject& subject, int count,
                                        double most_seconds, double available_memory) {
    constexpr double share = 0.8;  // of the memory that is there
    const double larger = count / static_cast<double>(smaller.grains);
    const double memory = smaller.memory * larger;
    if (memory > share * available_memory)
        return fmt::format("needs about {:.0f} GB of memory", memory / 1e9);
    const double steps =
        (subject.warm_up + subject.steps(count)) / static_cast<double>(subject.warm_up + smaller.steps);
    const double loop = smaller.wall / static_cast<double>(smaller.steps) *
                        static_cast<double>(subject.warm_up + smaller.steps);
    const double time = larger * (loop * steps + std::max(0.0, smaller.whole_wall - loop));
    if (time > most_seconds) return fmt::format("would take about {:.0f} s", time);
    return std::nullopt;
}

Profile read_profile(const std::string& table) {
    Profile profile;
    std::istringstream lines(table);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        double percent = 0.0;
        std::string sign, function;
        if (!(words >> percent >> sign) || sign != "%") continue;
        std::getline(words, function);
        const auto name = function.find("] ");
        profile[function.substr(name == std::string::npos ? 0 : name + 2)] += 0.01 * percent;
    }
    return profile;
}

void make_packings(const ScalingPlan& plan, const fs::path& folder) {
    Packings packings(folder / "packings");
    for (const Subject& subject : plan.subjects)
        for (const int count : subject.counts) packings.overrides(subject, count);
}

ScalingResults run_scaling(const ScalingPlan& plan, const ScalingOptions& options) {
    ScalingResults results;
    for (const Subject& subject : plan.subjects)
        for (const int count : subject.counts)
            for (const int threads : subject.threads)
                results.points.push_back({&subject, count, threads, {}, {}});
    Packings packings(options.folder / "packings");
    // Grains that are prepared by a method are made once for each number of them.
    ::setenv("SOFTGRAIN_CACHE", fs::absolute(options.folder / "packings").c_str(), 1);
    for (int repeat = 1; repeat <= options.repeats; ++repeat)
        for (ScalingPoint& point : results.points) {
            if (stop_signal() != 0) return results;
            if (!point.failure.empty()) continue;
            const StepsReport* smaller = point.repeats.empty() ? largest_below(results, point) : nullptr;
            if (const auto reason = smaller ? does_not_fit(*smaller, *point.of, point.count,
                                                           options.most_seconds, available_memory())
                                            : std::nullopt)
                point.failure = *reason;
            else
                run_once(point, packings);
            const std::string what =
                point.failure.empty() ? fmt::format("{:.3g} ns of CPU time a grain and step, {:.3g} s in all",
                                                    1e9 * point.cpu(), point.repeats.back().whole_wall)
                                      : point.failure;
            fmt::print("{}/{} {}, {} grains, {} threads: {}\n", repeat, options.repeats, point.of->name,
                       point.count, point.threads, what);
            std::fflush(stdout);
        }
    for (const Subject& subject : plan.subjects) {
        const ScalingPoint* measured = results.find(subject, subject.profile_count, 1);
        if (stop_signal() != 0 || !measured) continue;
        std::string failure;
        Profile profile = profile_of(*measured, packings, options.folder, failure);
        if (failure.empty())
            results.profiles.emplace(subject.name, std::move(profile));
        else
            results.unprofiled.emplace(subject.name, failure);
    }
    return results;
}

}  // namespace softgrain::bench
