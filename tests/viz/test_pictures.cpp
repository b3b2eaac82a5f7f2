// softgrain render RUN...: runs side by side.
#include "render_program.hpp"
#include "viz/render/scale.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

constexpr Colour warning{183, 65, 0, 255};

using Pictures = RenderProgram;

/// Pixels of a colour in a part of a picture, in shares of its width and height.
int count(const Picture& picture, Colour colour, int tolerance, double left, double right, double bottom,
          double top) {
    int found = 0;
    for (int y = static_cast<int>(bottom * picture.height()); y < static_cast<int>(top * picture.height());
         ++y)
        for (int x = static_cast<int>(left * picture.width()); x < static_cast<int>(right * picture.width());
             ++x)
            found += is_near(picture.pixel(x, y), colour, tolerance) ? 1 : 0;
    return found;
}

TEST_P(Pictures, RunsStandSideBySideOnOneScale) {
    write_hand_made_run(path_of("four"), 4, 2);
    write_hand_made_run(path_of("three"), 3, 2);
    const auto drawn = render(path_of("four") + " " + path_of("three") + " --field temperature --range 0,15");
    if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const std::string out = path_of("four") + "/pictures/temperature_last.png";
    EXPECT_EQ(drawn.out, out + "\n");
    const Picture picture(out);
    // Temperatures are 0 to 15 in the one and 0 to 8 in the other.
    const Colour hot = viridis(14.0 / 15.0), both = viridis(6.0 / 15.0);
    EXPECT_GT(count(picture, hot, 3, 0.0, 0.5, 0.3, 1.0), 1000);
    EXPECT_EQ(count(picture, hot, 3, 0.5, 1.0, 0.3, 1.0), 0);
    EXPECT_GT(count(picture, both, 3, 0.0, 0.5, 0.3, 1.0), 1000);
    EXPECT_GT(count(picture, both, 3, 0.5, 1.0, 0.3, 1.0), 1000);
    // A label over each: bold letters in the upper seven per cent.
    EXPECT_GT(count(picture, black, 60, 0.15, 0.35, 0.93, 1.0), 100);
    EXPECT_GT(count(picture, black, 60, 0.65, 0.85, 0.93, 1.0), 100);
    EXPECT_EQ(count(picture, black, 60, 0.45, 0.55, 0.93, 1.0), 0);
}

/// The box of a short run is as large as that of a long one where both were; later its panel says that it
/// ended.
TEST_P(Pictures, StagesAreThoseOfTheLoading) {
    write_hand_made_run(path_of("long"), 3, 5, 0.2);
    write_hand_made_run(path_of("short"), 3, 5, 0.1);
    std::ofstream(path_of("short") + "/run.json") << "{}\n";
    const std::string both = path_of("long") + " " + path_of("short") + " --at last,1 --out " + path_of("");
    const auto drawn = render(both);
    if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    EXPECT_NE(drawn.out.find("short went no farther"), std::string::npos) << drawn.out;
    const Picture common(path_of("mean_stress_last.png")), end(path_of("mean_stress_1.png"));
    const auto box_width = [](const Picture& picture, int from, int to) {
        int low = to, high = from;
        for (int x = from; x < to; ++x) {
            int dark = 0;
            for (int y = 0; y < picture.height(); ++y)
                dark += is_near(picture.pixel(x, y), black, 60) ? 1 : 0;
            if (dark < picture.height() / 3) continue;
            low = std::min(low, x);
            high = std::max(high, x);
        }
        return high - low;
    };
    const int half = common.width() / 2;
    EXPECT_NEAR(box_width(common, 0, half), box_width(common, half, 2 * half), 2);
    EXPECT_EQ(count(common, warning, 30, 0.0, 1.0, 0.5, 1.0), 0);
    // 0.8 against 0.9 of the box at the start.
    EXPECT_NEAR(box_width(end, 0, half) / static_cast<double>(box_width(end, half, 2 * half)), 8.0 / 9.0,
                0.01);
    EXPECT_EQ(count(end, warning, 30, 0.0, 0.5, 0.5, 1.0), 0);
    EXPECT_GT(count(end, warning, 30, 0.5, 1.0, 0.5, 1.0), 100);
}

TEST_P(Pictures, NumberedPicturesHaveOneFixedScale) {
    write_hand_made_run(path_of("run"), 3, 4);
    fs::create_directories(path_of("mean_stress_frames"));
    std::ofstream(path_of("mean_stress_frames/frame_0007.png")) << "left by a longer run\n";
    std::ofstream(path_of("mean_stress_frames/notes.txt")) << "of the user\n";
    const auto drawn = render(path_of("run") + " --at all --width 600 --out " + path_of(""));
    if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    std::vector<Picture> pictures;
    for (int k = 0; k < 4; ++k) {
        pictures.emplace_back(path_of("mean_stress_frames/frame_000" + std::to_string(k) + ".png"));
        EXPECT_EQ(pictures[k].height(), pictures[0].height());
    }
    EXPECT_FALSE(fs::exists(path_of("mean_stress_frames/frame_0004.png")));
    EXPECT_FALSE(fs::exists(path_of("mean_stress_frames/frame_0007.png")));
    EXPECT_TRUE(fs::exists(path_of("mean_stress_frames/notes.txt")));
    // The same bar, scale and key below the panel, pixel by pixel.
    const int footer = pictures[0].height() / 9;
    int different = 0, not_white = 0;
    for (int y = 0; y < footer; ++y)
        for (int x = 0; x < 600; ++x) {
            different += pictures[0].pixel(x, y) != pictures[3].pixel(x, y) ? 1 : 0;
            not_white += is_near(pictures[0].pixel(x, y), white, 2) ? 0 : 1;
        }
    EXPECT_EQ(different, 0);
    EXPECT_GT(not_white, 1000);
    const PanelOnPicture first(pictures[0], HandMadeGrains(3, 0.0, 0.0).box);
    const PanelOnPicture last(pictures[3], HandMadeGrains(3, 0.2, 0.0).box);
    EXPECT_NEAR(first.scale / last.scale, 1.0, 0.01);
}

/// Options with several numbers take no RUN behind them for one, with commas or without.
TEST_P(Pictures, OptionsMayStandBeforeTheRuns) {
    write_hand_made_run(path_of("run"), 2, 2);
    const std::string to = path_of("run") + " --out " + path_of("");
    for (const std::string options :
         {"--range 0,1 --at first", "--range=-1,-0.5 --at first,last", "--range -1 1",
          "--window 0,1,0,0.5 --range 0 1 --at-phi 0.9", "--window 0 1 0 0.5"}) {
        const auto drawn = render(options + " " + to);
        if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
        EXPECT_EQ(drawn.exit_code, 0) << options << ": " << drawn.err;
    }
}

TEST_P(Pictures, ARunThatIsGoingOnIsDrawnAsFarAsItIs) {
    write_hand_made_run(path_of("run"), 3, 2);
    std::ofstream(path_of("run") + "/history.csv", std::ios::app) << "40,400,0.2";  // a row half written
    const auto drawn = render(path_of("run"));
    if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
    EXPECT_EQ(drawn.exit_code, 0) << drawn.err;
}

/// Far more grains than pixels in a row: they keep their colours, and nothing else is drawn over them.
TEST_P(Pictures, AHundredThousandGrains) {
    const int n = 317;
    const HandMadeGrains grains(n, 0.1, 0.0);
    GrainWriter(path_of("run"), Need::all).observe(grains.view(), frame_sample(0));
    ContactWriter(path_of("run")).observe(grains.view(), frame_sample(0));
    const auto drawn = render(path_of("run") + " --field temperature --width 800");
    if (missing_graphics(drawn)) GTEST_SKIP() << drawn.err;
    ASSERT_EQ(drawn.exit_code, 0) << drawn.err;
    const Picture picture(path_of("run") + "/pictures/temperature_last.png");
    // Temperature grows from bottom to top: rows of one colour, white between the rounded grains.
    EXPECT_GT(count(picture, viridis(0.5), 40, 0.1, 0.9, 0.45, 0.6), 5000);
    EXPECT_EQ(count(picture, viridis(1.0), 40, 0.1, 0.9, 0.2, 0.5), 0);
}

TEST_P(Pictures, MistakesAreNamedInOneLine) {
    write_hand_made_run(path_of("run"), 2, 1);
    const std::string run = path_of("run");
    const std::vector<std::pair<std::string, std::string>> mistakes{
        {"", "softgrain render RUN"},
        {path_of("nowhere"), "nowhere: no such folder"},
        {run + " --at middle", "--at middle: can be first, last, all"},
        {run + " --at 1.5", "--at 1.5"},
        {run + " --at all,0.5", "--at all: goes with no other"},
        {run + " --film --at 0.5", "--film shows the whole loading"},
        {run + " --fps 0.01", "--fps"},
        {run + " --out x.mp4", "needs --film"},
        {run + " --at first,last --out x.png", "is one picture"},
        {run + " --width 3", "--width"},
        {run + " --field colour", "run: the grains have no scalar or vector field 'colour'; there are grain"},
        {run + " --at last --at-phi 0.9", "--at"}};
    for (const auto& [arguments, words] : mistakes) {
        const auto refused = render(arguments);
        EXPECT_EQ(refused.exit_code, 2) << arguments;
        EXPECT_NE(refused.err.find(words), std::string::npos) << refused.err;
        EXPECT_EQ(std::count(refused.err.begin(), refused.err.end(), '\n'), 1) << refused.err;
    }
    fs::remove(path_of("run/grains/grains_000000.vtp"));
    const auto gone = render(run);
    EXPECT_EQ(gone.exit_code, 4);
    EXPECT_NE(gone.err.find("grains_000000.vtp: cannot be read"), std::string::npos) << gone.err;
}

INSTANTIATE_TEST_SUITE_P(Graphics, Pictures, testing::Values(""),
                         [](const auto&) { return std::string("any"); });

}  // namespace
}  // namespace softgrain
