// A signal while a run is at something that takes long: a step of quasi-static MPM, the grains of BPM.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>

#include "tests/reliability/runs.hpp"
#include "tests/support/stop_later.hpp"

namespace softgrain {
namespace {

using namespace testing;
using Clock = std::chrono::steady_clock;

constexpr double long_wait =
    10.0;  // [s], ten times what a crowded machine needs; the work itself takes hours

class Stopped : public ReliabilityTest {
  protected:
    static void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }
};

/// The first step goes to the first sample, in a hundred equilibria.
TEST_F(Stopped, WithinAStepOfMpm) {
    const fs::path scenario =
        write("mpm.toml",
              "title = \"long steps\"\n[packing]\nsize_law = \"single\"\ncount = 9\n[[loading]]\n"
              "until_strain = 0.04\ninertial_number = 1e-3\n[sampling]\nstrain_interval = 0.02\n"
              "[mpm]\npoints_across_radius = 8\ndriver = \"quasi_static\"\nstrain_step = 2e-4\n");
    const auto command = [&](const fs::path& out, const std::vector<std::string>& more = {}) {
        std::vector<std::string> words{"run",        scenario.string(), "--method",  "mpm", "--out",
                                       out.string(), "--quiet",         "--threads", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    };
    const fs::path whole = folder / "whole", out = folder / "stopped";
    pid_t child = start(command(whole));
    wait_for_rows(whole / "history.csv", 1);
    const auto begin = Clock::now();
    wait_for_rows(whole / "history.csv", 2);
    const double first_step = seconds_since(begin);
    ASSERT_EQ(wait_for(child).exit_code, 0);

    double longest = 0.0;
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        child = start(command(out, {"--resume"}));
        wait_for_rows(out / "history.csv", 1);
        sleep(0.2 * first_step);
        ::kill(child, signal);
        const auto asked = Clock::now();
        const Outcome outcome = wait_for(child);
        longest = std::max(longest, seconds_since(asked));
        EXPECT_EQ(outcome.exit_code, 128 + signal) << outcome.err;
        EXPECT_NE(outcome.out.find("mpm: stopped by a signal; go on with --resume\n0 steps"),
                  std::string::npos)
            << outcome.out;
    }
    std::printf("the step takes %.2f s, a signal at most %.3f s\n", first_step, longest);
    EXPECT_LT(longest, 0.5 * first_step);
    EXPECT_EQ(softgrain(command(out, {"--resume"})).exit_code, 0);
    EXPECT_TRUE(same_results(whole, out));
}

TEST_F(Stopped, WhileTheGrainsOfBpmArePrepared) {
    const fs::path scenario =
        write("bpm.toml",
              "title = \"large grains\"\n[packing]\nsize_law = \"single\"\ncount = 3\n"
              "[[loading]]\nuntil_strain = 0.02\ninertial_number = 1e-3\n[bpm]\ndiscs_per_grain = 100000\n");
    const fs::path cache = folder / "cache", out = folder / "run";
    ::setenv("SOFTGRAIN_CACHE", cache.c_str(), 1);
    for (const double seconds : {0.5, 3.0}) {
        const pid_t child = start({"run", scenario.string(), "--method", "bpm", "--out", out.string(),
                                   "--quiet", "--threads", "2"});
        while (!fs::exists(out)) sleep(0.01);
        sleep(seconds);
        ::kill(child, SIGTERM);
        const auto asked = Clock::now();
        const Outcome outcome = wait_for(child);
        std::printf("a signal takes %.3f s\n", seconds_since(asked));
        EXPECT_LT(seconds_since(asked), long_wait);
        EXPECT_EQ(outcome.exit_code, 128 + SIGTERM);
        EXPECT_EQ(outcome.err,
                  "bpm: stopped by a signal while the grains were prepared; nothing was written\n");
        EXPECT_FALSE(fs::exists(out));
        EXPECT_FALSE(fs::exists(cache));
    }
    ::setenv("SOFTGRAIN_CACHE", "off", 1);
}

/// `compare` catches signals before its packing is made; `run` only then, and until then ends at once.
TEST_F(Stopped, WhileAPackingIsGenerated) {
    for (const std::string generator : {"growth", "compaction", "deposition"}) {
        const fs::path scenario =
            write("packing.toml",
                  "title = \"many grains\"\n[packing]\ngenerator = \"" + generator +
                      "\"\ncount = 100000\n[[loading]]\nuntil_strain = 0.02\ninertial_number = 1e-3\n");
        const pid_t child = start({"compare", scenario.string(), "--methods", "rigid_dem", "--out",
                                   (folder / "c").string(), "--quiet", "--no-pictures"});
        while (!fs::exists(folder / "c" / "view.py")) sleep(0.01);
        sleep(0.5);
        ::kill(child, SIGINT);
        const auto asked = Clock::now();
        const Outcome outcome = wait_for(child);
        std::printf("%s: a signal takes %.3f s\n", generator.c_str(), seconds_since(asked));
        EXPECT_LT(seconds_since(asked), long_wait) << generator;
        EXPECT_EQ(outcome.exit_code, 128 + SIGINT) << generator;
        EXPECT_EQ(outcome.err, "stopped by a signal\n") << generator;
        fs::remove_all(folder / "c");
    }
}

}  // namespace
}  // namespace softgrain
