// view.py run by ParaView itself (pvbatch), where it is installed.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "hand_made_grains.hpp"
#include "picture.hpp"
#include "viz/paraview/view_script.hpp"
#include "viz/render/scale.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
    std::stringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

/// pvbatch of $SOFTGRAIN_PARAVIEW, or else of the PATH; empty if there is none.
fs::path find_pvbatch() {
    if (const char* folder = std::getenv("SOFTGRAIN_PARAVIEW")) return fs::path(folder) / "pvbatch";
    std::istringstream path(std::getenv("PATH") == nullptr ? "" : std::getenv("PATH"));
    for (std::string folder; std::getline(path, folder, ':');)
        if (fs::exists(fs::path(folder) / "pvbatch")) return fs::path(folder) / "pvbatch";
    return {};
}

/// Share of the picture's left part, where the grains are, that has a colour of the map from `least` on.
double coloured_share(const Picture& picture, double least = 0.0) {
    std::vector<Colour> map;
    for (int k = 0; k <= 64; ++k) map.push_back(viridis(least + (1.0 - least) * k / 64.0));
    const int right = picture.width() * 4 / 5;
    int count = 0;
    for (int y = 0; y < picture.height(); y += 2)
        for (int x = 0; x < right; x += 2) {
            const auto pixel = picture.pixel(x, y);
            count += std::ranges::any_of(map, [&](Colour c) { return is_near(pixel, c, 6); }) ? 1 : 0;
        }
    return 4.0 * count / right / picture.height();
}

double percentile_98(const std::vector<HandMadeGrains>& states) {
    std::vector<double> values;
    for (const HandMadeGrains& state : states)
        for (const Mat2& s : state.stress) values.push_back((s(0, 0) + s(1, 1)) / 2.0);
    return percentile(values, 0.98);
}

class ViewScript : public testing::Test {
  protected:
    struct Outcome {
        int exit_code;
        std::string said;  ///< both outputs
    };

    void SetUp() override {
        if (pvbatch.empty())
            GTEST_SKIP() << "no pvbatch: tests/paraview/install_aside.sh FOLDER, then "
                            "SOFTGRAIN_PARAVIEW=FOLDER";
        fs::create_directories(results);
    }
    Outcome run(const std::string& arguments) const {
        const fs::path log = folder.path() / "log.txt";
        const int status =
            std::system(fmt::format("'{}' '{}' '{}' {} >'{}' 2>&1", SOFTGRAIN_WITH_DISPLAY, pvbatch.string(),
                                    (results / "view.py").string(), arguments, log.string())
                            .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(log)};
    }
    static bool holds(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

    TemporaryFolder folder;
    fs::path pvbatch = find_pvbatch();
    fs::path results = folder.path() / "results";
};

TEST_F(ViewScript, OpensTheRunsOfAFolderThatWasMoved) {
    write_hand_made_run(results / "sdem", 5, 4);
    write_hand_made_run(results / "bpm", 4, 3);
    write_view_script(results, {"sdem", "bpm", "mpm"});
    fs::rename(results, folder.path() / "moved here");
    results = folder.path() / "moved here";

    const Outcome last = run("");
    ASSERT_EQ(last.exit_code, 0) << last.said;
    for (const char* bad : {"Traceback", "ERR|", "Failed"}) EXPECT_FALSE(holds(last.said, bad)) << last.said;
    EXPECT_TRUE(holds(last.said, "skipped mpm: ")) << last.said;
    EXPECT_TRUE(holds(last.said, "mpm/grains.pvd is missing")) << last.said;
    EXPECT_TRUE(holds(last.said, "runs: sdem, bpm\n")) << last.said;
    EXPECT_TRUE(holds(last.said, "time steps: 4\n")) << last.said;

    std::vector<HandMadeGrains> states;
    for (int frame = 0; frame < 4; ++frame) states.emplace_back(5, 0.2 * frame / 3.0, 0.0);
    for (int frame = 0; frame < 3; ++frame) states.emplace_back(4, 0.2 * frame / 2.0, 0.0);
    const auto at = last.said.find("colour range: 0 to ");
    ASSERT_NE(at, std::string::npos) << last.said;
    std::istringstream range(last.said.substr(at + 19));
    double high = 0.0;
    std::string unit;
    range >> high >> unit;
    // 10 %: two ways to interpolate between the values next to a percentile.
    EXPECT_NEAR(high, percentile_98(states), 0.1 * high);
    EXPECT_EQ(unit, "N/m");

    // Two square packings that have shrunk to 0.64 of their place, and labels above them.
    const Picture picture(results / "view.png");
    EXPECT_GT(coloured_share(picture), 0.3);
    EXPECT_GT(picture.share_of(white, 4), 0.1);
    EXPECT_GT(picture.share_of(black, 40), 0.01);  // outlines, walls, force chains

    // At the start there is less stress than at the end, on the same scale.
    const fs::path first_picture = folder.path() / "first.png";
    const Outcome first = run("--at 0 --out '" + first_picture.string() + "'");
    ASSERT_EQ(first.exit_code, 0) << first.said;
    const Picture start(first_picture);
    EXPECT_EQ(start.width(), picture.width());
    EXPECT_GT(coloured_share(start), 0.4);
    EXPECT_LT(coloured_share(start, 0.6), coloured_share(picture, 0.6));
}

TEST_F(ViewScript, DrawsPointsAsDiscs) {
    const HandMadeGrains grains(5, 0.1, 1.0);
    GrainWriter(results, Need::area | Need::stress).observe(grains.view(), frame_sample(0));
    WallWriter(results).observe(grains.view(), frame_sample(0));
    write_view_script(results, {"."});
    const Outcome outcome = run("");
    ASSERT_EQ(outcome.exit_code, 0) << outcome.said;
    EXPECT_TRUE(holds(outcome.said, "without contacts: ")) << outcome.said;
    const Outcome nowhere = run("--out /nowhere/picture.png");
    EXPECT_EQ(nowhere.exit_code, 4) << nowhere.said;
    EXPECT_TRUE(holds(nowhere.said, "/nowhere/picture.png: cannot be written")) << nowhere.said;
    // One packing: 0.8 of its width, and discs cover at least half of it; points without size would be
    // nothing.
    EXPECT_GT(coloured_share(Picture(results / "view.png")), 0.4);
}

TEST_F(ViewScript, SaysWhatItCannotOpen) {
    write_view_script(results, {"sdem"});
    const Outcome nothing = run("");
    EXPECT_EQ(nothing.exit_code, 2) << nothing.said;
    EXPECT_TRUE(holds(nothing.said, "none of the runs sdem can be opened")) << nothing.said;
    const Outcome beyond = run("--at 1.5");
    EXPECT_EQ(beyond.exit_code, 2) << beyond.said;
    EXPECT_TRUE(holds(beyond.said, "--at")) << beyond.said;
}

}  // namespace
}  // namespace softgrain
