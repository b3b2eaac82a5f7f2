// `softgrain bench steps`, `scaling` and `peers` as their users run them.
#include <algorithm>

#include "app/bench/scaling/steps.hpp"
#include "tests/bench/program.hpp"

namespace softgrain {
namespace {

using ScalingProgram = BenchFolder;

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

TEST_F(ScalingProgram, StepsAreMeasuredOnceThoseBeforeAreDone) {
    const std::string scenario =
        "steps scenarios/packing24/isotropic.toml --method sdem --warm-up 20 --steps ";
    const Outcome few = bench(scenario + "50"), many = bench(scenario + "1000");
    ASSERT_EQ(few.exit_code, 0) << few.said;
    const bench::StepsReport less = bench::steps_report(few.said), more = bench::steps_report(many.said);
    EXPECT_EQ(less.grains, 24U);
    EXPECT_EQ(less.steps, 50);
    EXPECT_EQ(more.steps, 1000);
    EXPECT_GT(more.cpu, less.cpu);
    EXPECT_GT(less.cpu, 0.0);
    EXPECT_GE(less.whole_wall, less.wall);
    EXPECT_GT(less.memory, 0.0);
}

TEST_F(ScalingProgram, AQuickScalingHasItsFiles) {
    const std::string out = (folder / "s").string();
    const Outcome done = bench("scaling --quick --repeats 1 --out " + out);
    ASSERT_EQ(done.exit_code, 0) << done.said;
    EXPECT_TRUE(has(done.said, "1/1 sdem, 400 grains, 2 threads: ")) << done.said;
    const std::string csv = content(folder / "s" / "scaling.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4 + 2) << csv;
    EXPECT_TRUE(content(folder / "s" / "scaling.md").starts_with("# Scaling\n"));
    for (const char* name : {"cost.svg", "threads.svg", "memory.svg"})
        EXPECT_TRUE(has(content(folder / "s" / name), "</svg>")) << name;
    const Outcome again = bench("scaling --quick --repeats 1 --out " + out);
    EXPECT_EQ(again.exit_code, 2);
    EXPECT_TRUE(has(again.said, "--force")) << again.said;
}

TEST_F(ScalingProgram, AQuickBenchOfPeersHasItsFiles) {
    const Outcome done = bench("peers --quick --repeats 1 --out " + (folder / "p").string());
    ASSERT_EQ(done.exit_code, 0) << done.said;
    const std::string csv = content(folder / "p" / "peers.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2) << csv;
    EXPECT_TRUE(has(csv, "\"law lens_potential\"")) << csv;
    EXPECT_TRUE(has(content(folder / "p" / "peers.svg"), "</svg>"));
}

TEST_F(ScalingProgram, BadInputIsExitTwo) {
    const std::string out = " --out " + (folder / "b").string();
    for (const auto& [arguments, said] :
         {std::pair<std::string, std::string>{"scaling --quick --method mpm" + out, "it has sdem, rigid_dem"},
          {"scaling --quick --most-grains 10" + out, "nothing to run is left"},
          {"scaling --plan nowhere.toml" + out, "nowhere.toml: there is no such plan file"},
          {"peers --quick --peer PFC" + out, "it has chords by polygons"},
          {"steps scenarios/packing24/isotropic.toml --method fem --steps 1", "sdem, bpm, rigid_dem, mpm"},
          {"steps scenarios/packing24/isotropic.toml --method sdem --steps 0", "--steps"},
          {"steps scenarios/single_grain/four_walls.toml --method rigid_dem --steps 1000000 --set "
           "rigid_dem.inertial_number=1",
           "1000001 are asked for"}}) {
        const Outcome o = bench(arguments);
        EXPECT_EQ(o.exit_code, 2) << arguments << o.said;
        EXPECT_TRUE(has(o.said, said)) << o.said;
    }
}

}  // namespace
}  // namespace softgrain
