// Which runs are meant, and which of their frames belong together.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "common/errors.hpp"
#include "hand_made_grains.hpp"
#include "viz/render/loading_path.hpp"
#include "viz/render/run_list.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

class LoadingPathTest : public testing::Test {
  protected:
    TemporaryFolder folder;
    std::vector<RunReader> runs;

    void add_run(const std::string& name, int frames, double strain) {
        write_hand_made_run(folder.path() / name, 3, frames, strain);
        runs.emplace_back(name, folder.path() / name);
    }
};

/// Frames every 0.05 of strain against every 0.0125, these to half of the strain only.
TEST_F(LoadingPathTest, FramesAreMatchedByPackingFraction) {
    add_run("long", 5, 0.2);
    add_run("short", 9, 0.1);
    const LoadingPath path(runs, false);
    EXPECT_EQ(path.quantity(), "packing fraction");
    const auto& phi = runs[0].packing_fractions();
    EXPECT_EQ(path.start(), phi[0]);
    EXPECT_EQ(path.end(), phi[4]);
    EXPECT_DOUBLE_EQ(path.last_common(), runs[1].packing_fractions()[8]);
    EXPECT_EQ(path.match(0, path.last_common()).frame, 2U);
    EXPECT_EQ(path.match(1, path.last_common()).frame, 8U);
    EXPECT_EQ(path.match(1, phi[1]).frame, 4U);
    EXPECT_FALSE(path.match(1, path.last_common()).beyond_end);
    EXPECT_EQ(path.match(1, path.end()).frame, 8U);
    EXPECT_TRUE(path.match(1, path.end()).beyond_end);
    EXPECT_FALSE(path.match(0, path.end()).beyond_end);
    // All frames of the one, then those of the other that lie behind.
    const auto stages = path.all_stages();
    ASSERT_EQ(stages.size(), 11U);
    EXPECT_EQ(stages.back(), phi[4]);
    EXPECT_TRUE(std::is_sorted(stages.begin(), stages.end()));
}

/// A cycle comes twice to the same packing fraction; the path of strain goes on.
TEST_F(LoadingPathTest, ACycleIsFollowedByItsPathOfStrain) {
    write_hand_made_run(folder.path() / "cycle", 3, 3, 0.2);
    std::ofstream(folder.path() / "cycle/history.csv")
        << "time,axial_strain,packing_fraction\n0,0,0.7\n20,0.1,0.9\n40,0,0.7\n";
    runs.emplace_back("cycle", folder.path() / "cycle");
    const LoadingPath path(runs, false);
    EXPECT_EQ(path.quantity(), "path of strain");
    EXPECT_DOUBLE_EQ(path.end(), 0.2);
    EXPECT_EQ(path.match(0, 0.19).frame, 2U);
    EXPECT_EQ(LoadingPath(runs, true).match(0, 0.88).frame, 1U);
    fs::remove(folder.path() / "cycle/history.csv");
    const std::vector<RunReader> without{RunReader("cycle", folder.path() / "cycle")};
    EXPECT_EQ(LoadingPath(without, false).quantity(), "time");
    EXPECT_THROW(LoadingPath(without, true), InputError);
}

TEST_F(LoadingPathTest, AComparisonStandsForItsRunsInItsOrder) {
    for (const char* name : {"a/zeta", "a/alpha", "a/beta", "b/zeta"}) add_run(name, 1, 0.0);
    std::ofstream(folder.path() / "a/comparison.csv")
        << "method,packing_fraction\nzeta,0.8\nzeta,0.9\nbeta,0.8\n";
    fs::create_directories(folder.path() / "a/pictures");
    const std::string root = folder.path();
    const auto comparison = find_runs({root + "/a"});
    ASSERT_EQ(comparison.size(), 3U);
    EXPECT_EQ(comparison[0].label, "zeta");
    EXPECT_EQ(comparison[1].label, "beta");
    EXPECT_EQ(comparison[2].label, "alpha");
    const auto both = find_runs({root + "/a/zeta/", root + "/b/zeta", root + "/a/beta"});
    ASSERT_EQ(both.size(), 3U);
    EXPECT_EQ(both[0].label, "a/zeta");
    EXPECT_EQ(both[1].label, "b/zeta");
    EXPECT_EQ(both[2].label, "beta");
    EXPECT_EQ(find_runs({"fine=" + root + "/a"})[1].label, "fine beta");
}

TEST_F(LoadingPathTest, LabelsAndFoldersMayHoldEqualsSignsAndCommas) {
    add_run("nu=0.3,E=1", 1, 0.0);
    const std::string run = folder.path() / "nu=0.3,E=1";
    EXPECT_EQ(find_runs({run})[0].label, "nu=0.3,E=1");
    const NamedRun named = find_runs({"mu=0.5, e=1=" + run})[0];
    EXPECT_EQ(named.label, "mu=0.5, e=1");
    EXPECT_EQ(named.folder, run);
    EXPECT_EQ(labelled_run("a=b=" + run, "--run").label, "a=b");
    EXPECT_EQ(labelled_run("a=" + run, "--run").label, "a");
}

std::string input_error(const std::vector<std::string>& words) {
    try {
        find_runs(words);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

TEST_F(LoadingPathTest, WhatIsNoRunIsNamed) {
    add_run("one", 1, 0.0);
    const std::string root = folder.path();
    EXPECT_NE(input_error({root + "/none"}).find("/none: no such folder"), std::string::npos);
    EXPECT_NE(input_error({"label=" + root + "/none"}).find(root + "/none: no such folder"),
              std::string::npos);
    fs::create_directories(root + "/empty");
    EXPECT_NE(input_error({root + "/empty"}).find("neither the folder of a run"), std::string::npos);
    EXPECT_NE(input_error({root + "/one", root + "/one"}).find("two runs have the name"), std::string::npos);
    EXPECT_NE(input_error({"x=" + root + "/one", "x=" + root + "/one"}).find("two runs have the name 'x'"),
              std::string::npos);
}

}  // namespace
}  // namespace softgrain
