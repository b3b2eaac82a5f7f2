// What a run leaves where its method never comes to a first step.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "app/methods.hpp"
#include "app/run_folder.hpp"
#include "common/errors.hpp"
#include "common/io/scenario_file.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain {
namespace {

namespace fs = std::filesystem;

/// Found by random scenarios: it left an empty folder, and ended a comparison.
TEST(RunFolder, GrainsThatCannotBePreparedAreExitThreeWithoutAFolder) {
    Method method = find_method("rigid_dem");
    method.make = [](const Scenario&, const Packing&) -> std::unique_ptr<Solver> {
        throw DivergedError(3, "disc position", 0.5, "out of reach");
    };
    const Scenario scenario =
        parse_scenario("[packing]\ncount = 4\n[[loading]]\nuntil_strain = 0.1\nstrain_rate = 1\n", "s.toml",
                       {}, method_keys());
    const Packing packing = make_packing(scenario);
    const fs::path folder =
        fs::path(::testing::TempDir()) / ("softgrain_folder_" + std::to_string(::getpid()));
    const auto run = [&] {
        return run_into_folder(
            {.scenario = scenario, .packing = packing, .method = method, .folder = folder, .quiet = true});
    };
    const RunReport report = run();
    EXPECT_EQ(report.exit_code, 3);
    EXPECT_FALSE(report.has_results);
    EXPECT_EQ(report.ended,
              "cannot prepare the grains: diverged: disc position of grain 3 at t = 0.5: out of reach");
    EXPECT_FALSE(fs::exists(folder));
    fs::create_directory(folder);
    run();
    EXPECT_TRUE(fs::exists(folder)) << "it was there before";
    fs::remove(folder);
}

}  // namespace
}  // namespace softgrain
