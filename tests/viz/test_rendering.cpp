// Pictures of grains, plots, and what can go wrong.
#include <cmath>
#include <fstream>
#include <string>

#include "rendering.hpp"
#include "viz/render/scale.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

/// A sheared cell is drawn as a parallelogram with slanted sides, grains that stick out within the picture.
TEST_P(Rendering, ACellIsDrawnWithItsTilt) {
    HandMadeGrains grains(4, 0.1, 0.0);
    grains.box.periodic = true;
    grains.box.tilt = 0.4 * grains.box.width();
    const fs::path run = folder.path() / "cell";
    GrainWriter(run, Need::all).observe(grains.view(), frame_sample(0));
    WallWriter(run).observe(grains.view(), frame_sample(0));
    FramesSpec spec;
    spec.runs = {{"cell", run}};
    spec.at = {0.0};
    spec.field = "mean_stress";
    spec.out = folder.path() / "pictures";
    spec.width = 800;
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    const Picture picture(spec.out / "cell_1.png");
    // Grains and cell span 1.4 widths; margins are 1.2 / 52 of the page on each side.
    const double scale = (800.0 - 2.0 * 1.2 * 800.0 / 52.0) / (1.4 * 0.9);
    const auto dark_near = [&](const Vec2& from_middle, double bottom) {
        int found = 0;
        for (int dx = -3; dx <= 3; ++dx)
            for (int dy = -3; dy <= 3; ++dy) {
                const int x = static_cast<int>(std::lround(400.0 + scale * from_middle.x())) + dx;
                const int y = static_cast<int>(std::lround(bottom + scale * from_middle.y())) + dy;
                found += is_near(picture.pixel(x, y), black, 40) ? 1 : 0;  // darker than outlines
            }
        return found > 0;
    };
    // The slanted sides cross the empty corners of the extent's rectangle: find the bottom edge first.
    const int middle = 400;
    int bottom = 0;
    for (int y = 100; y < picture.height() / 2 && bottom == 0; ++y) {
        int run_length = 0;
        for (int x = middle - 250; x < middle; ++x)
            run_length +=
                is_near(picture.pixel(x, y), black, 90) || is_near(picture.pixel(x, y + 1), black, 90);
        if (run_length > 240) bottom = y;
    }
    ASSERT_GT(bottom, 0) << "no bottom edge";
    for (const double up : {0.02, 0.45, 0.88}) {
        const double left = -0.63 + 0.4 * up;
        EXPECT_TRUE(dark_near({left, up}, bottom)) << "left side at " << up;
        EXPECT_TRUE(dark_near({left + 0.9, up}, bottom)) << "right side at " << up;
    }
}

TEST_P(Rendering, GrainsHaveTheColoursOfTheirValues) {
    const fs::path run = folder.path() / "run";
    write_hand_made_run(run, 4, 3);
    FramesSpec spec;
    spec.runs = {{"hand made", run}};
    spec.at = {0.0, 1.0};
    spec.field = "temperature";
    spec.range = {0.0, 15.0};
    spec.out = folder.path() / "pictures";
    spec.width = 800;
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;

    const Picture picture(spec.out / "hand_made_2.png");
    EXPECT_EQ(picture.width(), 800);
    const HandMadeGrains state(4, 0.2, 40.0);
    const PanelOnPicture panel(picture, state.box);
    ASSERT_GT(panel.scale, 400.0);
    for (std::size_t g = 0; g < state.centroid.size(); ++g) {
        // A quarter of a grain aside of its centre, where no force chain runs.
        const Vec2 aside = Vec2{0.05, 0.05} * (g % 4 == 3 ? 0.8 : 1.0);
        const auto [x, y] = panel.at(state.box, state.centroid[g] + aside);
        EXPECT_TRUE(is_near(picture.pixel(x, y), viridis(static_cast<double>(g) / 15.0), 4))
            << "grain " << g << " at " << x << ", " << y;
    }
    // Between four rounded grains there is paper.
    const auto [x, y] = panel.at(state.box, Vec2{0.5, 0.5});
    EXPECT_TRUE(is_near(picture.pixel(x, y), white, 2));
    // The strongest contact is drawn black over the grains, all along its line.
    std::size_t strongest = 0;
    for (std::size_t k = 0; k < state.contacts.size(); ++k)
        if (state.contacts[k].normal_force() > state.contacts[strongest].normal_force()) strongest = k;
    const GrainContact& contact = state.contacts[strongest];
    const Vec2 from = state.centroid[static_cast<std::size_t>(contact.i)];
    for (const double share : {0.3, 0.6}) {
        const auto [cx, cy] = panel.at(state.box, from + share * (contact.point - from));
        EXPECT_TRUE(is_near(picture.pixel(cx, cy), black, 10));
    }
    // Without stress there is no chain: the first frame's grains are whole.
    const Picture first(spec.out / "hand_made_1.png");
    const HandMadeGrains start(4, 0.0, 0.0);
    const PanelOnPicture first_panel(first, start.box);
    const auto [sx, sy] = first_panel.at(start.box, start.centroid[5]);
    EXPECT_TRUE(is_near(first.pixel(sx, sy), viridis(5.0 / 15.0), 4));
    // One scale: pixels per metre are the same at both stages, to the rounding of the walls' pixels.
    EXPECT_NEAR(first_panel.scale / panel.scale, 1.0, 0.01);

    const Picture sheet(spec.out / "sheet.png");
    EXPECT_EQ(sheet.width(), 800);
    EXPECT_GT(sheet.share_of(viridis(0.0), 4), 0.003);
    EXPECT_LT(sheet.share_of(white, 2), 0.8);
}

TEST_P(Rendering, GrainsWithoutOutlinesAreDiscs) {
    const fs::path run = folder.path() / "run";
    const HandMadeGrains state(3, 0.1, 1.0);
    GrainWriter(run, Need::area).observe(state.view(), frame_sample(0));
    FramesSpec spec;
    spec.runs = {{"points", run}};
    spec.at = {0.0};
    spec.field = "grain";
    spec.range = {0.0, 8.0};
    spec.out = folder.path();
    spec.width = 600;
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    EXPECT_GT(Picture(spec.out / "points_1.png").share_of(viridis(0.5), 4), 0.02);
}

TEST_P(Rendering, StagesByPackingFraction) {
    write_hand_made_run(folder.path() / "run", 3, 3);
    FramesSpec spec;
    spec.runs = {{"one", folder.path() / "run"}, {"two", folder.path() / "run"}};
    spec.at_packing_fraction = {0.5, 0.8};
    spec.out = folder.path();
    spec.width = 400;
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    for (const char* name : {"one_1.png", "one_2.png", "two_1.png", "two_2.png", "sheet.png"})
        EXPECT_EQ(Picture(folder.path() / name).width(), 400) << name;
    spec.runs.pop_back();
    fs::remove(folder.path() / "run/history.csv");
    const auto without_history = render_frames(spec);
    ASSERT_TRUE(without_history);
    EXPECT_NE(without_history->find("use --at"), std::string::npos) << *without_history;
}

TEST_P(Rendering, PlotShowsEverySeries) {
    PlotSpec spec;
    spec.title = "Test";
    spec.x.label = "packing fraction";
    spec.y.label = "mean stress [N/m]";
    spec.width = 800;
    spec.height = 600;
    write_hand_made_run(folder.path() / "run", 3, 4);
    PlotSeries from_file;
    from_file.label = "from a file";
    from_file.csv = folder.path() / "run/history.csv";
    from_file.x_column = "packing_fraction";
    from_file.y_column = "mean_stress";
    PlotSeries inline_numbers;
    inline_numbers.label = "band";
    inline_numbers.x = {0.7, 0.8, 0.9};
    inline_numbers.y = {0.001, 0.01, 0.015};
    inline_numbers.lower = {0.0, 0.008, 0.012};
    inline_numbers.upper = {0.002, 0.012, 0.018};
    inline_numbers.line = LineStyle::none;
    inline_numbers.marker = MarkerStyle::square;
    spec.series = {from_file, inline_numbers};
    for (const bool logarithmic : {false, true}) {
        spec.y.logarithmic = logarithmic;
        const fs::path out = folder.path() / "plots/stress.png";
        const auto error = render_plot(spec, out);
        if (missing(error)) GTEST_SKIP() << *error;
        ASSERT_FALSE(error) << *error;
        const Picture picture(out);
        EXPECT_EQ(picture.width(), 800);
        EXPECT_EQ(picture.height(), 600);
        EXPECT_GT(picture.share_of({0, 114, 178, 255}, 8), 3e-4);    // the line: some 400 x 2 pixels
        EXPECT_GT(picture.share_of({213, 94, 0, 255}, 8), 2e-4);     // three squares
        EXPECT_GT(picture.share_of({247, 223, 205, 255}, 8), 2e-3);  // the band: 50 of 255 parts
        EXPECT_GT(picture.share_of(white, 2), 0.7);
        fs::remove(out);
    }
    EXPECT_TRUE(fs::exists(folder.path() / "plots/stress.json"));
}

TEST_P(Rendering, ASeriesOfOnePointIsDrawn) {
    PlotSpec spec;
    PlotSeries point;
    point.x = {0.9};
    point.y = {0.01};
    point.line = LineStyle::none;
    point.marker = MarkerStyle::square;
    spec.series = {point};
    const fs::path out = folder.path() / "point.png";
    const auto error = render_plot(spec, out);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    EXPECT_GT(Picture(out).share_of({0, 114, 178, 255}, 8), 2e-5);
}

TEST_P(Rendering, TruncatedFrameIsNamed) {
    write_hand_made_run(folder.path() / "run", 3, 1);
    const fs::path frame = folder.path() / "run/contacts/contacts_000000.vtp";
    fs::resize_file(frame, fs::file_size(frame) / 2);
    FramesSpec spec;
    spec.runs = {{"a", folder.path() / "run"}};
    spec.out = folder.path();
    const auto error = render_frames(spec);
    ASSERT_TRUE(error);
    EXPECT_NE(error->find("contacts_000000.vtp: is cut short"), std::string::npos) << *error;
}

INSTANTIATE_TEST_SUITE_P(Graphics, Rendering, testing::Values("egl", "xvfb"),
                         [](const auto& parameter) { return std::string(parameter.param); });

TEST(RenderingErrors, NoRendererIsToldToTheCaller) {
    ::setenv("SOFTGRAIN_RENDER_EXE", "/nowhere/softgrain-render", 1);
    const auto error = render_plot(PlotSpec{}, fs::temp_directory_path() / "softgrain-none/none.png");
    fs::remove_all(fs::temp_directory_path() / "softgrain-none");
    ASSERT_TRUE(error);
    EXPECT_NE(error->find("SOFTGRAIN_RENDER_EXE"), std::string::npos);
}

/// Exit code of a shell command with stderr in `messages`.
int exit_code(const std::string& command, const fs::path& messages) {
    const int status = std::system((command + " 2> " + messages.string()).c_str());
    return WEXITSTATUS(status);
}

TEST(RenderingErrors, ExitCodesTellTheKindOfFailure) {
    const TemporaryFolder folder;
    const std::string program = SOFTGRAIN_RENDER_EXE;
    const fs::path messages = folder.path() / "messages";
    const std::string run = folder.path() / "run";
    const std::string frames = program + " frames --run a=" + run + " --out " + folder.path().string();
    EXPECT_EQ(exit_code(frames, messages), 2);  // no run there
    write_hand_made_run(run, 2, 1);
    EXPECT_EQ(exit_code(frames + " --field colour", messages), 2);
    EXPECT_EQ(exit_code("SOFTGRAIN_RENDER=paint " + frames, messages), 2);
    EXPECT_EQ(exit_code(program + " frames --out x", messages), 2);
    EXPECT_EQ(exit_code(program + " --help > /dev/null", messages), 0);
    // Neither libEGL nor Xvfb to be found.
    const std::string bare = "env -u DISPLAY PATH=/nowhere __EGL_VENDOR_LIBRARY_DIRS=/nowhere ";
    EXPECT_EQ(exit_code(bare + frames, messages), 4);
    std::ifstream file(messages);
    std::string line, more;
    std::getline(file, line);
    EXPECT_NE(line.find("no off-screen graphics"), std::string::npos) << line;
    EXPECT_FALSE(std::getline(file, more)) << more;
}

}  // namespace
}  // namespace softgrain
