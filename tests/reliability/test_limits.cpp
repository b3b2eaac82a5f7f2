// What a scenario may ask for: memory, and files outside its folder.
#include <gtest/gtest.h>

#include "app/methods.hpp"
#include "common/errors.hpp"
#include "tests/reliability/runs.hpp"

namespace softgrain {
namespace {

using namespace testing;

class Limits : public ReliabilityTest {};

TEST_F(Limits, ARunThatNeedsTooMuchMemoryIsRefusedBeforeItBegins) {
    const fs::path out = folder / "run";
    const Outcome outcome =
        softgrain(run_of("mpm", out, {"--set", "packing.count=1000000", "--memory", "1G"}));
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_NE(outcome.err.find("mpm needs ~15 GB for ~1e+06 grains; the limit is "), std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("see --memory"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(out));
}

TEST_F(Limits, APathLeavesTheScenariosFolderOnlyWhereItIsAllowed) {
    fs::create_directories(folder / "below");
    write("disc.csv", "x,y,r\n1,1,1\n");
    const auto read = [&](const std::string& path, NamedFiles files) {
        return parse_scenario("[packing]\npath = \"" + path +
                                  "\"\n[box]\nwidth = 2\nheight = 2\n[[loading]]\nuntil_strain = 0.1\n"
                                  "strain_rate = 1\n",
                              folder / "below" / "s.toml", {}, method_keys(), files);
    };
    EXPECT_EQ(read("../disc.csv", NamedFiles::anywhere).packing.path, folder / "disc.csv");
    EXPECT_EQ(read("../below/../disc.csv", NamedFiles::anywhere).packing.path, folder / "disc.csv");
    try {
        read("../disc.csv", NamedFiles::inside);
        FAIL() << "read a file outside";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("s.toml:2:8: packing.path leads out of"), std::string::npos) << text;
        EXPECT_NE(text.find("allow it with --allow-outside"), std::string::npos) << text;
    }
    EXPECT_NO_THROW(read((folder / "disc.csv").string(), NamedFiles::inside)) << "an absolute path is plain";
    const fs::path here = fs::current_path();
    fs::current_path(folder);
    EXPECT_NO_THROW(read("../disc.csv", NamedFiles::inside)) << "it stays within the current folder";
    fs::current_path(here);
}

}  // namespace
}  // namespace softgrain
