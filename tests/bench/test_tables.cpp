// Tables and plots of made-up rows.
#include "app/bench/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "app/bench/plots.hpp"
#include "tests/bench/support.hpp"

namespace softgrain::bench {
namespace {

class Tables : public ::testing::Test {
  protected:
    void SetUp() override {
        one.rows.own_error[stress] = 0.03;
        one.add(fast, 1.0, 0.15);
        one.add(slow, 4.0, 0.02);
        one.add(partial, 0.5, 0.5, 0.3);
        one.add(failed, 0.1, 0.001, 1.0, 3);
        one.add(fine, 1234.0, 0.06);
    }
    static bool has(const std::string& text, const std::string& part) {
        return text.find(part) != std::string::npos;
    }

    const Setting fast = setting("sdem", "fast"), slow = setting("sdem", "slow"),
                  partial = setting("rigid_dem", "partial"), failed = setting("bpm", "failed"),
                  fine = setting("mpm", "fine");
    MadeUp one{"one"};
};

TEST_F(Tables, MarkdownSaysWhatIsCheapestAndWhatIsKnown) {
    Plan plan;
    plan.headlines = {{"one", "sdem", "knob", 0.05, 300.0}, {"one", "sdem", "knob", 0.01, 300.0}};
    const std::string text = error_markdown(plan, {one.rows});
    EXPECT_TRUE(has(text, "sdem (knob, slow) is **310 times cheaper** than mpm (knob, fine)")) << text;
    EXPECT_TRUE(has(text, "asked is 300 times at 5 %: reached")) << text;
    EXPECT_TRUE(has(text, "no sdem within 1 % of stress")) << text;
    EXPECT_TRUE(has(text, "own (2.0 %)")) << text;
    EXPECT_TRUE(has(text, "the largest over the least is 2.00")) << text;
    EXPECT_TRUE(has(text, "own error: mean stress 3.0 %")) << text;
    const auto row_with = [&](const std::string& begin) {
        const auto at = text.find("| " + begin);
        return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
    };
    EXPECT_TRUE(has(row_with("20 %"), "sdem, knob, fast")) << row_with("20 %");
    EXPECT_TRUE(has(row_with("20 %"), "1200 (knob, fine)")) << row_with("20 %");
    EXPECT_TRUE(has(row_with("10 %"), "310 (knob, fine)")) << row_with("10 %");
    EXPECT_FALSE(has(row_with("2 %"), "sdem")) << "2 % is below the reference's own error";
    EXPECT_TRUE(has(row_with("rigid_dem, knob, partial"), "30 %"));
    EXPECT_TRUE(has(row_with("bpm, knob, failed"), "diverged"));
    EXPECT_TRUE(has(row_with("* sdem, knob, slow"), "own")) << "on the front";
}

TEST_F(Tables, CsvHasARowForEachSettingWithItsReason) {
    const std::string text = error_csv({one.rows});
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1 + 5);
    EXPECT_TRUE(has(
        text, "one,bpm,\"knob\",\"failed\",\"bpm.failed\",0.1,0.1,0.2,3,0.1,50000000,10,1.0000,0.001,0.03,"))
        << text;
    EXPECT_TRUE(has(text, ",\"diverged: at once\",3,")) << text;
}

TEST_F(Tables, ThePlotHasALineForEachKnobAFrontAndABand) {
    const auto plot = error_plot(one.rows, stress);
    ASSERT_TRUE(plot);
    const auto labelled = [&](const std::string& label) -> const PlotSeries& {
        return *std::ranges::find(plot->series, label, &PlotSeries::label);
    };
    EXPECT_EQ(labelled("sdem, knob").x, (std::vector<double>{1.0, 4.0}));
    EXPECT_EQ(labelled("sdem, knob").y, (std::vector<double>{0.15, 0.02}));
    EXPECT_EQ(labelled("Pareto front").y, (std::vector<double>{0.15, 0.02}));
    EXPECT_EQ(labelled("reference's own error").upper, (std::vector<double>{0.03, 0.03}));
    EXPECT_NE(labelled("sdem, knob").colour, labelled("mpm, knob").colour);
    EXPECT_EQ(std::ranges::count(plot->series, MarkerStyle::cross, &PlotSeries::marker), 2);
    EXPECT_GT(*plot->x.max, 1234.0);
    EXPECT_LT(*plot->y.min, 0.001);
    EXPECT_FALSE(error_plot(one.rows, 1)) << "no error of Z was measured";
}

}  // namespace
}  // namespace softgrain::bench
