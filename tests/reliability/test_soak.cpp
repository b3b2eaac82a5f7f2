// Random scenarios of all methods, one after the other in this process, so that what one run does not give
// back is there after the next. SOFTGRAIN_SOAK_SECONDS sets for how long (default 10), SOFTGRAIN_SOAK_SEED
// where they begin, SOFTGRAIN_SOAK_LOG a CSV file with a row for each run.
#include <gtest/gtest.h>
#include <malloc.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "app/bench/stability/draw.hpp"
#include "app/bench/stability/finite_files.hpp"
#include "app/memory.hpp"
#include "app/methods.hpp"
#include "app/process.hpp"
#include "app/run_folder.hpp"
#include "common/errors.hpp"
#include "common/io/scenario_file.hpp"
#include "common/packing/make_packing.hpp"
#include "common/stop.hpp"

namespace softgrain {
namespace {

namespace fs = std::filesystem;

constexpr double longest_run = 10.0;  // [s] of CPU time
constexpr std::uint64_t largest_run =
    100'000'000;  // [bytes] expected; BPM may be asked for any number of discs
constexpr std::size_t least_runs = 24;
// What libraries keep for later use, [bytes] a run and in all. A run that kept its grains would keep more.
constexpr std::size_t may_grow_by_run = 64 * 1024, may_grow = 1024 * 1024;

std::string variable(const char* name, const char* otherwise) {
    const char* text = std::getenv(name);
    return text == nullptr ? otherwise : text;
}

/// Asks this process to stop once it has used so much CPU time from now on.
class Alarm {
  public:
    explicit Alarm(double seconds) {
        install_stop_signals();
        sigevent event{};
        event.sigev_notify = SIGEV_SIGNAL;
        event.sigev_signo = SIGTERM;
        timer_create(CLOCK_PROCESS_CPUTIME_ID, &event, &timer_);
        itimerspec when{};
        when.it_value.tv_sec = static_cast<time_t>(seconds);
        timer_settime(timer_, 0, &when, nullptr);
    }
    Alarm(const Alarm&) = delete;
    Alarm& operator=(const Alarm&) = delete;
    ~Alarm() { timer_delete(timer_); }

  private:
    timer_t timer_{};
};

/// In use, whoever asked for it [bytes].
std::size_t heap_in_use() {
    const struct mallinfo2 heap = mallinfo2();
    return heap.uordblks + heap.hblkhd;
}

std::size_t resident() {
    std::ifstream file("/proc/self/statm");
    std::size_t all = 0, pages = 0;
    file >> all >> pages;
    return pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

struct Ended {
    int exit_code = 2;
    long long steps = 0;
    std::string reason;
};

Ended run(const std::string& text, const Method& method, int threads, const fs::path& folder) {
    const Alarm alarm(longest_run);
    try {
        const Scenario scenario = parse_scenario(text, "soak.toml", {}, method_keys());
        check_memory(scenario, method, largest_run);
        const Packing packing = make_packing(scenario);
        const RunReport report = run_into_folder({.scenario = scenario,
                                                  .packing = packing,
                                                  .method = method,
                                                  .folder = folder,
                                                  .threads = threads,
                                                  .quiet = true});
        return {report.exit_code, report.steps, report.ended};
    } catch (const InputError& error) {
        return {2, 0, error.what()};
    } catch (const StopAsked& stopped) {
        return {128 + SIGTERM, 0, stopped.what()};
    }
}

TEST(Soak, RandomScenariosInOneProcessKeepNoMemory) {
    const double seconds = std::stod(variable("SOFTGRAIN_SOAK_SECONDS", "10"));
    std::uint64_t seed = std::stoull(variable("SOFTGRAIN_SOAK_SEED", "100000"));
    std::ofstream log(variable("SOFTGRAIN_SOAK_LOG", "/dev/null"));
    log << "seed,method,threads,exit_code,steps,seconds,heap_in_use,resident,reason\n";
    const fs::path folder = fs::path(::testing::TempDir()) / ("softgrain_soak_" + std::to_string(::getpid()));
    const double begin = wall_clock();
    std::map<std::string, int> ends;
    std::vector<std::size_t> heap;
    while (wall_clock() - begin < seconds || heap.size() < least_runs) {
        for (const Method& method : methods()) {
            const std::string text = bench::draw_scenario(seed, method.name).text;
            const int threads = 1 + static_cast<int>(seed % 3);
            const double start = wall_clock();
            const Ended ended = run(text, method, threads, folder);
            SCOPED_TRACE(std::string(method.name) + ", seed " + std::to_string(seed) + ", " + ended.reason);
            const bool stopped = ended.exit_code == 128 + SIGTERM;
            ASSERT_TRUE(ended.exit_code == 0 || ended.exit_code == 2 || ended.exit_code == 3 || stopped)
                << ended.exit_code;
            ASSERT_FALSE(ended.reason.empty());
            if (fs::exists(folder / "history.csv")) {
                const auto bad = bench::not_finite_in_run(folder, method);
                ASSERT_FALSE(bad) << *bad;
            }
            fs::remove_all(folder);
            heap.push_back(heap_in_use());
            ++ends[std::string(method.name) + (ended.exit_code == 0   ? " done"
                                               : ended.exit_code == 2 ? " refused"
                                               : ended.exit_code == 3 ? " diverged"
                                                                      : " stopped")];
            log << seed << ',' << method.name << ',' << threads << ',' << ended.exit_code << ','
                << ended.steps << ',' << wall_clock() - start << ',' << heap.back() << ',' << resident()
                << ",\"" << ended.reason.substr(0, ended.reason.find('\n')) << '"' << std::endl;
        }
        ++seed;
    }
    for (const auto& [what, count] : ends) std::printf("%6d %s\n", count, what.c_str());
    const auto third = static_cast<std::ptrdiff_t>(heap.size() / 3);
    const std::size_t before = *std::min_element(heap.begin() + third, heap.end() - third),
                      after = *std::min_element(heap.end() - third, heap.end());
    std::printf("%zu runs, heap in use: at least %zu bytes in the second third, %zu in the last\n",
                heap.size(), before, after);
    EXPECT_LT(after, before + std::min(may_grow, static_cast<std::size_t>(third) * may_grow_by_run));
}

}  // namespace
}  // namespace softgrain
