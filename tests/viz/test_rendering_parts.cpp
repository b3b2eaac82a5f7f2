// Pictures of what grains are made of.
#include "rendering.hpp"
#include "viz/render/scale.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {
namespace fs = std::filesystem;

class RenderingParts : public Rendering {
  protected:
    static constexpr int width = 600;
    HandMadeGrains grains{3, 0.1, 1.0};
    HandMadeParts parts{grains};
    FramesSpec spec;

    void SetUp() override {
        Rendering::SetUp();
        spec.runs = {{"run", folder.path() / "run"}};
        spec.at = {0.0};
        spec.field = "heat";
        spec.range = {0.0, 1.0};
        spec.parts = true;
        spec.out = folder.path() / "pictures";
        spec.width = width;
    }
    void write_run(const fs::path& run) const {
        GrainView view = grains.view();
        view.parts = parts.view();
        GrainWriter(run, Need::all).observe(view, frame_sample(0));
        ContactWriter(run).observe(view, frame_sample(0));
        WallWriter(run).observe(view, frame_sample(0));
        PartWriter(run, true).observe(view, frame_sample(0));
    }
    /// The colour of each part beside its contacts is that of value(part).
    template <class Value>
    void expect_colours(const Picture& picture, Value value) const {
        const PanelOnPicture panel(picture, grains.box);
        for (std::size_t p = 0; p < parts.position.size(); ++p) {
            const auto [x, y] = panel.at(grains.box, beside_the_lines(p));
            EXPECT_TRUE(is_near(picture.pixel(x, y), viridis(value(p)), 4)) << "part " << p;
        }
    }
    /// Down to the right, where no contact's line runs.
    Vec2 beside_the_lines(std::size_t part) const {
        return parts.position[part] + 0.57 * parts.radius[part] * Vec2(1.0, -1.0);
    }
};

TEST_P(RenderingParts, PartsHaveTheColoursOfTheirValues) {
    parts.contacts = {{0, 1, 2.0, 0.0}, {1, 3, 0.5, 0.0}};
    write_run(folder.path() / "run");
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    const Picture picture(spec.out / "run_1.png");
    expect_colours(picture, [&](std::size_t p) { return parts.heat[p]; });
    const PanelOnPicture panel(picture, grains.box);
    // The strong contact of the first two parts is black where they meet, between the next two is nothing.
    const auto [x, y] = panel.at(grains.box, 0.5 * (parts.position[0] + parts.position[1]));
    EXPECT_TRUE(is_near(picture.pixel(x, y), black, 10));
    const auto [nx, ny] = panel.at(grains.box, parts.position[4] + Vec2(0.5 * parts.radius[4], 0.0));
    EXPECT_TRUE(is_near(picture.pixel(nx, ny), viridis(parts.heat[4]), 4));
}

TEST_P(RenderingParts, AFieldOfTheGrainsColoursTheirParts) {
    parts.contacts.clear();
    write_run(folder.path() / "run");
    spec.field = "temperature";
    spec.range = {0.0, 8.0};
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    const Picture picture(spec.out / "run_1.png");
    expect_colours(picture, [&](std::size_t p) { return parts.grain[p] / 8.0; });
}

/// A window of a quarter of the box shows it at twice the scale, and nothing outside its frame.
TEST_P(RenderingParts, AWindowIsCutOut) {
    write_run(folder.path() / "run");
    spec.field = "grain";
    spec.range = {0.0, 8.0};
    spec.parts = false;
    spec.window = {{0.0, 0.5, 0.0, 0.5}};
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    const Picture picture(spec.out / "run_1.png");
    // Grains 0, 1, 3 and 4 are in it, 2, 5 and 6 to 8 are not.
    EXPECT_GT(picture.share_of(viridis(0.0), 3), 0.05);
    EXPECT_GT(picture.share_of(viridis(1.0 / 8.0), 3), 0.02);
    // Not of the colour bar, which has the colours of the others: the panel is above the lower fifth.
    int of_others = 0, in_margin = 0;
    const int margin = 10;  // 1.2 / 52 of the width is 13 pixels
    for (int y = picture.height() / 4; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) {
            for (const double grain : {2.0, 5.0, 6.0, 7.0, 8.0})
                of_others += is_near(picture.pixel(x, y), viridis(grain / 8.0), 3) ? 1 : 0;
            if (x < margin || x >= picture.width() - margin)
                in_margin += is_near(picture.pixel(x, y), white, 2) ? 0 : 1;
        }
    EXPECT_EQ(of_others, 0);
    EXPECT_EQ(in_margin, 0);
}

/// In one sheet with a run that has parts, another without is drawn by its grains, with a key of its own.
TEST_P(RenderingParts, ARunWithoutPartsIsDrawnAsEver) {
    write_run(folder.path() / "run");
    write_hand_made_run(folder.path() / "plain", 3, 1);
    spec.runs.push_back({"plain", folder.path() / "plain"});
    spec.field = "temperature";
    spec.range = {0.0, 8.0};
    const auto error = render_frames(spec);
    if (missing(error)) GTEST_SKIP() << *error;
    ASSERT_FALSE(error) << *error;
    const HandMadeGrains plain(3, 0.0, 0.0);
    const Picture picture(spec.out / "plain_1.png");
    const PanelOnPicture panel(picture, plain.box);
    const auto [x, y] = panel.at(plain.box, plain.centroid[4] + Vec2(0.08, 0.05));
    EXPECT_TRUE(is_near(picture.pixel(x, y), viridis(0.5), 4));
    spec.field = "heat";
    const auto no_field = render_frames(spec);
    ASSERT_TRUE(no_field);
    EXPECT_NE(no_field->find("no scalar or vector field 'heat'"), std::string::npos) << *no_field;
}

TEST_P(RenderingParts, AWindowThatIsNoneIsRefused) {
    write_run(folder.path() / "run");
    for (const std::array<double, 4>& window : std::vector<std::array<double, 4>>{
             {0.5, 0.5, 0.0, 1.0}, {0.0, 1.0, 0.8, 0.2}, {-0.1, 1.0, 0.0, 1.0}, {0.0, 1.0, 0.0, 1.1}}) {
        spec.window = window;
        const auto error = render_frames(spec);
        ASSERT_TRUE(error);
        EXPECT_NE(error->find("--window"), std::string::npos) << *error;
    }
}

// With whatever graphics there is: what is drawn does not depend on it.
INSTANTIATE_TEST_SUITE_P(Graphics, RenderingParts, testing::Values(""),
                         [](const auto&) { return std::string("any"); });

}  // namespace
}  // namespace softgrain
