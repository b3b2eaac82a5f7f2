// The arithmetic of `softgrain bench scaling`: packings, plans, parts of the time, limits; on made-up
// numbers.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "app/bench/scaling/limit_kernels.hpp"
#include "app/bench/scaling/machine_limits.hpp"
#include "app/bench/scaling/scaling_tables.hpp"
#include "app/bench/scaling/tiles.hpp"
#include "app/methods.hpp"
#include "common/errors.hpp"
#include "common/packing/tiled.hpp"

namespace softgrain::bench {
namespace {

namespace fs = std::filesystem;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST(Tiles, TakesAsFewCopiesAsTheCellAllows) {
    EXPECT_EQ(copies_of(100), 1);
    EXPECT_EQ(copies_of(1000), 1);
    EXPECT_EQ(copies_of(10000), 4) << "of 625 grains";
    EXPECT_EQ(copies_of(100000), 10) << "of 1000 grains";
    EXPECT_EQ(copies_of(1000000), 40) << "of 625 grains";
    EXPECT_THROW(copies_of(1009), InputError) << "a prime number";
}

TEST(Tiles, CopiesLieSideBySide) {
    Packing cell;
    cell.box = Box{{1.0, 4.0, 0.0, 2.0}};
    cell.center = {{1.5, 0.5}, {3.0, 1.75}};
    cell.radius = {0.5, 0.25};
    const Packing many = tiled(cell, 2);
    ASSERT_EQ(many.size(), 8U);
    EXPECT_EQ(many.center[7], Vec2(6.0, 3.75)) << "the last copy is one cell further right and up";
    EXPECT_EQ(many.box.position, (std::array<double, 4>{1.0, 7.0, 0.0, 4.0}));
}

TEST(Tiles, GrainsOverlapAsFarAsTheyAreSqueezed) {
    Scenario scenario;
    scenario.packing.count = 1;  // replaced
    const Packing packing = tiled_packing(scenario, 200);
    ASSERT_EQ(packing.size(), 200U);
    double deepest = 0.0;
    int touching = 0;
    for (std::size_t i = 0; i < packing.size(); ++i) {
        for (int wall = 0; wall < 4; ++wall)
            deepest =
                std::max(deepest, 1.0 - packing.box.distance(wall, packing.center[i]) / packing.radius[i]);
        for (std::size_t j = 0; j < i; ++j) {
            const double sum = packing.radius[i] + packing.radius[j];
            const double overlap = 1.0 - (packing.center[i] - packing.center[j]).norm() / sum;
            deepest = std::max(deepest, overlap);
            touching += overlap > 0.0 ? 1 : 0;
        }
    }
    EXPECT_GT(deepest, 0.9 * squeeze);
    EXPECT_LT(deepest, 1.001 * squeeze) << "what just touched, and nothing deeper";
    EXPECT_GT(2.0 * touching / 200.0, 3.0) << "a jammed packing has nearly four contacts a grain";
}

class ScalingPlans : public ::testing::Test {
  protected:
    void SetUp() override {
        folder = fs::path(::testing::TempDir()) / ("softgrain_scaling_" + std::to_string(::getpid()));
        fs::create_directories(folder);
        std::ofstream(folder / "s.toml") << "title = \"s\"\n";
    }
    void TearDown() override { fs::remove_all(folder); }
    ScalingPlan read(const std::string& text) const {
        std::ofstream(folder / "p.toml") << text;
        return read_scaling_plan(folder / "p.toml");
    }
    std::string error(const std::string& text) const {
        try {
            read(text);
        } catch (const InputError& found) {
            return found.what();
        }
        return "";
    }
    static std::string subject(const std::string& counts, const std::string& profile,
                               const std::string& method = "sdem") {
        return "[[subject]]\nname = \"a\"\nmethod = \"" + method + "\"\nscenario = \"s.toml\"\ncounts = \"" +
               counts +
               "\"\nthreads = \"1, 2\"\nwarm_up = 3\nleast_steps = 10\nwork = 5e3\nprofile_count = " +
               profile + "\n";
    }
    fs::path folder;
};

TEST_F(ScalingPlans, HaveAsManyStepsAsTheirWorkAsksFor) {
    const ScalingPlan plan = read(subject("400, 100", "100"));
    ASSERT_EQ(plan.subjects.size(), 1U);
    const Subject& one = plan.subjects.front();
    EXPECT_EQ(one.counts, (std::vector<int>{100, 400})) << "rising";
    EXPECT_EQ(one.threads, (std::vector<int>{1, 2}));
    EXPECT_EQ(one.steps(100), 50);
    EXPECT_EQ(one.steps(10000), 10) << "at least";
    EXPECT_TRUE(plan.kernels.empty()) << "no kernels.toml beside it";
}

TEST_F(ScalingPlans, ReadKernelsAndCountsBesideThem) {
    std::ofstream(folder / "kernels.toml")
        << "[[kernel]]\nmethod = \"sdem\"\ntitle = \"chords\"\nfunctions = \"solve_chords, chord\"\n";
    std::ofstream(folder / "kernels.csv") << "# made by hand\nmethod,kernel,flops,bytes,far_bytes\n"
                                             "sdem,chords,100,50.5,10\n";
    const ScalingPlan plan = read(subject("100", "100"));
    ASSERT_EQ(plan.kernels.size(), 1U);
    EXPECT_EQ(plan.kernels[0].functions, (std::vector<std::string>{"solve_chords", "chord"}));
    ASSERT_EQ(plan.counts.size(), 1U);
    EXPECT_EQ(plan.counts[0].bytes, 50.5);
    std::ofstream(folder / "kernels.csv") << "sdem,chords,many,2,3\n";
    EXPECT_TRUE(
        has(error(subject("100", "100")), "kernels.csv:1: must be method,kernel,flops,bytes,far_bytes"));
}

TEST_F(ScalingPlans, ErrorsNameLineAndCure) {
    for (const auto& [text, said] : std::vector<std::pair<std::string, std::string>>{
             {"", "subject is missing: write at least one [[subject]]"},
             {subject("100, x", "100"),
              "p.toml:5:10: subject.0.counts must be whole numbers >= 1, got \"x\""},
             {subject("1009", "1009"),
              "p.toml:5:10: subject.0.counts 1009 grains: must be at most 1000 times"},
             {subject("100", "200"), "p.toml:10:17: subject.0.profile_count must be one of the counts"},
             {subject("100", "100", "fem"), "p.toml:3:10: subject.0.method must be one of sdem"},
             {subject("100", "100") + subject("100", "100"), "subject.1.name names another subject already"},
             {subject("100", "100") + "wrok = 3\n", "unknown key 'wrok', did you mean 'work'?"}})
        EXPECT_TRUE(has(error(text), said)) << "expected: " << said << "\ngot: " << error(text);
}

TEST_F(ScalingPlans, ThoseOfTheProjectAreSound) {
    for (const char* name : {"plan.toml", "quick.toml", "counted.toml"}) {
        const ScalingPlan plan = read_scaling_plan(fs::path(SOFTGRAIN_SOURCE) / "bench/scaling" / name);
        EXPECT_FALSE(plan.subjects.empty()) << name;
        for (const Subject& one : plan.subjects) {
            const Scenario scenario = read_scenario(one.scenario, one.set, method_keys());
            EXPECT_NO_THROW(scenario_for(scenario, find_method(one.method))) << one.name;
        }
    }
}

StepsReport report(std::size_t grains, long long steps, double cpu, double wall, double memory,
                   double whole) {
    StepsReport one;
    one.method = "sdem";
    one.grains = grains;
    one.steps = steps;
    one.cpu = cpu;
    one.wall = wall;
    one.memory = memory;
    one.whole_wall = whole;
    return one;
}

/// One subject with 100 and 400 grains, 1 and 2 threads.
class MadeUpScaling : public ::testing::Test {
  protected:
    MadeUpScaling() {
        plan.subjects = {{"a", "sdem", "s.toml", {}, {100, 400, 900}, {1, 2}, 5, 10, 1e3, 400}};
        plan.kernels = {{"sdem", "chords", {"solve_chords"}},
                        {"sdem", "sums", {"sum_contacts", "load_block"}}};
        plan.counts = {{"sdem", "chords", 100.0, 400.0, 0.0}, {"sdem", whole_step, 300.0, 600.0, 3000.0}};
        const Subject* a = plan.subjects.data();
        results.points = {{a, 100, 1, {report(100, 10, 1e-3, 2e-3, 1e5, 0.1)}, {}},
                          {a,
                           400,
                           1,
                           {report(400, 10, 2e-3, 4e-3, 2e5, 0.1), report(400, 10, 6e-3, 4e-3, 4e5, 0.1),
                            report(400, 10, 4e-3, 5e-3, 3e5, 0.1)},
                           {}},
                          {a, 400, 2, {report(400, 10, 4e-3, 2e-3, 2e5, 0.1)}, {}},
                          {a, 900, 1, {}, "would take about 77 s"}};
        results.profiles["a"] = {{"x::solve_chords", 0.25},
                                 {"y::sum_contacts", 0.2},
                                 {"y::load_block", 0.1},
                                 {"strange", 0.3},
                                 {"rare", 0.01}};
    }
    ScalingPlan plan;
    ScalingResults results;
};

TEST_F(MadeUpScaling, CostsAreMediansOfTheRepeats) {
    const ScalingPoint& one = results.points[1];
    EXPECT_DOUBLE_EQ(one.cpu(), 1e-6) << "4 ms for 400 grains and 10 steps";
    EXPECT_DOUBLE_EQ(one.wall(), 1e-6);
    EXPECT_DOUBLE_EQ(one.memory(), 750.0);
    EXPECT_DOUBLE_EQ(one.spread(), 3.0);
    EXPECT_EQ(results.find(plan.subjects[0], 900, 1), nullptr) << "it has not run";
}

TEST_F(MadeUpScaling, PartsAddUpToAll) {
    const auto parts = parts_of("sdem", results.profiles["a"], plan.kernels);
    ASSERT_EQ(parts.size(), 4U);
    EXPECT_EQ(parts[0].title, "chords");
    EXPECT_DOUBLE_EQ(parts[1].share, 0.2 + 0.1);
    EXPECT_EQ(parts[2].title, "strange");
    EXPECT_EQ(parts[3].title, "others");
    EXPECT_NEAR(parts[3].share, 1.0 - 0.25 - 0.3 - 0.3, 1e-12) << "with the rare one";
}

TEST_F(MadeUpScaling, TheLeastLimitBinds) {
    const MachineLimits limits{1e10, 0.0, 1e11, 1e10};
    const auto points = roofline(plan, results, limits);
    ASSERT_EQ(points.size(), 2U);
    EXPECT_DOUBLE_EQ(points[0].time, 0.25 * 1e-6);
    EXPECT_DOUBLE_EQ(points[0].rate, 100.0 / 0.25e-6);
    EXPECT_EQ(points[0].bound, RooflinePoint::Bound::arithmetic)
        << "0.25 flops a byte in cache would be 2.5e10";
    EXPECT_DOUBLE_EQ(points[0].limit, 1e10);
    EXPECT_EQ(points[1].bound, RooflinePoint::Bound::memory) << "0.1 flops for a byte from memory";
    EXPECT_DOUBLE_EQ(points[1].limit, 1e9);
    EXPECT_DOUBLE_EQ(points[1].rate, 300.0 / 1e-6);
    const auto cached = roofline(plan, results, {1e12, 0.0, 1e9, 1e10});
    EXPECT_EQ(cached[0].bound, RooflinePoint::Bound::cache);
    EXPECT_DOUBLE_EQ(cached[0].limit, 0.25e9);
}

TEST_F(MadeUpScaling, TablesShowWhatRanAndWhyTheRestDidNot) {
    const MachineLimits limits{1e10, 0.0, 1e11, 1e10};
    const std::string text = scaling_markdown(plan, results, limits);
    EXPECT_TRUE(has(text, "would take about 77 s")) << text;
    EXPECT_TRUE(has(text, "the largest CPU time over the least is 1.00 (median over the runs), at most 3.00"))
        << text;
    EXPECT_TRUE(has(text, "|     400 |       2 |") || has(text, "|    400 |       2 |")) << text;
    EXPECT_TRUE(has(text, "a, whole step")) << text;
    const std::string csv = scaling_csv(results);
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4) << csv;
    EXPECT_TRUE(has(csv, "a,400,2,5,10,1,1000,500,1.000,500.0,")) << csv;
    EXPECT_TRUE(has(csv, "\"would take about 77 s\"")) << csv;
    EXPECT_TRUE(
        has(roofline_csv(roofline(plan, results, limits), limits), "a,whole step,1.0000,1000,300,600,3000,"));
}

TEST_F(MadeUpScaling, PlotsHaveALineForEachNumberOfThreads) {
    const auto plots = scaling_plots(plan, results, {1e10, 0.0, 1e11, 1e10});
    ASSERT_EQ(plots.size(), 4U);
    EXPECT_EQ(plots[0].name, "cost");
    ASSERT_EQ(plots[0].plot.series.size(), 2U);
    EXPECT_EQ(plots[0].plot.series[0].x, (std::vector<double>{100.0, 400.0}));
    EXPECT_EQ(plots[1].name, "threads");
    EXPECT_EQ(plots[1].plot.series.at(0).y, (std::vector<double>{2.0})) << "4 ms beside 2 ms";
    EXPECT_EQ(plots[3].name, "roofline");
    EXPECT_EQ(plots[3].plot.series.size(), 2U + 2U) << "two roofs and two kernels";
}

TEST(Fits, IsJudgedByASmallerRun) {
    const Subject subject{"a", "sdem", "s.toml", {}, {100, 1000}, {1}, 10, 10, 1.0, 100};
    // 10 + 10 steps of 0.1 s, 1 s before: ten times that is 30 s.
    const StepsReport smaller = report(100, 10, 1.0, 1.0, 1e6, 3.0);
    EXPECT_FALSE(does_not_fit(smaller, subject, 1000, 31.0, 1e9));
    EXPECT_EQ(does_not_fit(smaller, subject, 1000, 29.0, 1e9), "would take about 30 s");
    EXPECT_EQ(does_not_fit(smaller, subject, 100000, 1e9, 1e9), "needs about 1 GB of memory");
}

TEST(Profiles, AreReadFromTheTableOfPerf) {
    const Profile profile = read_profile(
        "\n    25.50%  [.] softgrain::sdem::solve_chords\n     4.00%  [k] clear_page\n"
        "     1.50%  [.] softgrain::sdem::f(int, double)\nnot a row\n");
    ASSERT_EQ(profile.size(), 3U);
    EXPECT_NEAR(profile.at("softgrain::sdem::solve_chords"), 0.255, 1e-12);
    EXPECT_NEAR(profile.at("softgrain::sdem::f(int, double)"), 0.015, 1e-12);
}

TEST(Steps, ReportsSurviveTheirText) {
    StepsReport one = report(7, 3, 0.1, 0.2, 3.0, 0.5);
    one.threads = 2;
    one.processor = "1 x \"X\"";
    const StepsReport again = steps_report(to_json(one));
    EXPECT_EQ(again.processor, one.processor);
    EXPECT_EQ(again.cpu, one.cpu);
    EXPECT_EQ(again.threads, 2);
    EXPECT_THROW(steps_report("{\"method\": \"sdem\"}"), InputError);
    EXPECT_THROW(steps_report("nonsense"), InputError);
}

TEST(MachineLimits, KernelsDoTheWorkThatIsCounted) {
    // x a + b from 0, 1, ... goes to b / (1 - a) = 1 in each of the lanes.
    EXPECT_NEAR(multiply_and_add_4(40000), 4.0 * chains, 1e-6);
    EXPECT_NEAR(multiply_and_add_8(40000), 8.0 * chains, 1e-6);
    double a[5] = {}, b[5] = {1, 2, 3, 4, 5}, c[5] = {1, 1, 1, 1, 2};
    EXPECT_EQ(triad(a, b, c, 3.0, 5), 6.0);
    EXPECT_EQ(a[4], 11.0);
}

}  // namespace
}  // namespace softgrain::bench
