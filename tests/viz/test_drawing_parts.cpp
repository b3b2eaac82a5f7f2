#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "common/errors.hpp"
#include "common/observables/shape.hpp"
#include "hand_made_grains.hpp"
#include "viz/csv_table.hpp"
#include "viz/plot_data.hpp"
#include "viz/render/scale.hpp"
#include "viz/render/triangulate.hpp"

namespace softgrain {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string input_error(const std::string& json) {
    try {
        plot_spec_from_json(json, "spec.json");
    } catch (const InputError& error) {
        return error.what();
    }
    return "no InputError";
}

// The triangles cover the polygon exactly once: all turn the same way and their areas sum to its area.
TEST(Triangulate, StarAndSpiralAreCoveredOnce) {
    std::vector<Vec2> star, comb;
    for (int k = 0; k < 30; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 30, radius = k % 2 == 0 ? 3.0 : 1.0;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    for (int k = 0; k < 6; ++k) {
        comb.emplace_back(k, k % 2 == 0 ? 0.0 : 5.0);
        comb.emplace_back(k + 0.5, k % 2 == 0 ? 0.0 : 5.0);
    }
    comb.emplace_back(6.0, -1.0);
    comb.emplace_back(-1.0, -1.0);
    for (std::vector<Vec2> polygon : {star, comb})
        for (const bool reversed : {false, true}) {
            if (reversed) std::reverse(polygon.begin(), polygon.end());
            const auto triangles = triangulate(polygon);
            EXPECT_EQ(triangles.size(), polygon.size() - 2);
            double sum = 0.0;
            for (const auto& t : triangles) {
                const auto at = [&](int k) {
                    return polygon[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
                };
                const double area = cross(at(1) - at(0), at(2) - at(0)) / 2.0;
                EXPECT_GE(area, 0.0);
                sum += area;
            }
            EXPECT_NEAR(sum, std::abs(polygon_shape(polygon).area), 1e-12);
        }
    EXPECT_TRUE(triangulate(std::vector<Vec2>{{0, 0}, {1, 0}}).empty());
}

// The quick way for convex polygons, and one that only looks convex because it goes round twice.
TEST(Triangulate, ConvexPolygonsAreCoveredOnce) {
    std::vector<Vec2> oval, pentagram;
    for (int k = 0; k < 12; ++k) {
        const double angle = 2.0 * std::numbers::pi * k / 12;
        oval.emplace_back(3.0 * std::cos(angle), std::sin(angle));
    }
    for (int k = 0; k < 5; ++k) {
        const double angle = 4.0 * std::numbers::pi * k / 5;
        pentagram.emplace_back(std::cos(angle), std::sin(angle));
    }
    for (const bool reversed : {false, true}) {
        if (reversed) std::reverse(oval.begin(), oval.end());
        double sum = 0.0;
        for (const auto& t : triangulate(oval)) {
            const auto at = [&](int k) {
                return oval[static_cast<std::size_t>(t[static_cast<std::size_t>(k)])];
            };
            const double area = cross(at(1) - at(0), at(2) - at(0)) / 2.0;
            EXPECT_GT(area, 0.0);
            sum += area;
        }
        EXPECT_NEAR(sum, std::abs(polygon_shape(oval).area), 1e-12);
    }
    EXPECT_EQ(triangulate(pentagram).size(), 3U);
}

TEST(Scale, RangeIsRobustAndStartsAtZero) {
    std::vector<double> values;
    for (int k = 1; k <= 1000; ++k) values.push_back(k);
    values.push_back(1e9);
    values.push_back(nan);
    const ColourRange range = robust_range(values);
    EXPECT_EQ(range.min, 0.0);
    EXPECT_NEAR(range.max, 980.0, 2.0);  // the 98th percentile, to one rank
    EXPECT_TRUE(range.above);
    EXPECT_FALSE(range.below);
    const ColourRange both = robust_range({-3.0, -2.0, 0.0, 5.0});
    EXPECT_EQ(both.min, -3.0);
    EXPECT_EQ(both.max, 5.0);
    EXPECT_EQ(robust_range({0.0, 0.0}).max, 1.0);
    EXPECT_EQ(robust_range({}).max, 1.0);
}

TEST(Scale, TicksAreRoundAndWithin) {
    const std::vector<std::pair<double, double>> ranges{
        {0.0, 1.0}, {0.0, 0.3}, {0.8231, 0.9412}, {-7.0, 3.0}, {0.0, 3e-5}};
    for (const auto& [min, max] : ranges) {
        const auto ticks = round_ticks(min, max);
        EXPECT_GE(ticks.size(), 3U);
        EXPECT_LE(ticks.size(), 9U);
        EXPECT_GE(ticks.front(), min);
        EXPECT_LE(ticks.back(), max);
    }
    EXPECT_EQ(round_ticks(0.0, 0.3).back(), 0.3);
    EXPECT_EQ(tick_text(0.85, 0.05), "0.85");
    EXPECT_EQ(tick_text(0.9, 0.05), "0.90");
    EXPECT_EQ(tick_text(1e-17, 0.05), "0");
    EXPECT_EQ(tick_text(2e-5, 1e-5), "2e-05");
    EXPECT_EQ(round_down(0.49), 0.2);
    EXPECT_EQ(round_down(50.0), 50.0);
}

TEST(Scale, ViridisEndsAndClamps) {
    EXPECT_EQ(viridis(0.0), (Colour{0x44, 0x01, 0x54, 255}));
    EXPECT_EQ(viridis(1.0), (Colour{0xFD, 0xE7, 0x25, 255}));
    EXPECT_EQ(viridis(7.0), viridis(1.0));
    EXPECT_NE(viridis(nan), viridis(0.0));
}

// White is 0 wherever the ends are, and equal sizes are equally dark.
TEST(Scale, BothSignsHaveColoursOfTheirOwn) {
    const ColourRange range = robust_range({-1.0, -0.5, 2.0, 4.0});
    ASSERT_TRUE(range.has_both_signs());
    EXPECT_EQ(colour_of(range, 0.0), purple_orange(0.0));
    EXPECT_EQ(colour_of(range, 4.0), purple_orange(1.0));
    EXPECT_EQ(colour_of(range, -1.0), purple_orange(-0.25));
    EXPECT_GT(colour_of(range, -1.0)[2], colour_of(range, -1.0)[1]);  // purple: more blue than green
    EXPECT_LT(colour_of(range, 1.0)[2], colour_of(range, 1.0)[1]);    // orange: less
    EXPECT_EQ(colour_of(range, nan), viridis(nan));
    const ColourRange one_sign = robust_range({0.0, 1.0, 4.0});
    EXPECT_EQ(colour_of(one_sign, 4.0), viridis(1.0));
    EXPECT_EQ(colour_of(one_sign, 0.0), viridis(0.0));
}

TEST(PlotSpecTest, SurvivesJson) {
    PlotSpec spec;
    spec.title = "a \"title\"";
    spec.x = {"x [m]", true, 0.1, std::nullopt};
    spec.legend = "right";
    PlotSeries one;
    one.label = "one";
    one.x = {1.0, 2.0};
    one.y = {0.1, nan};
    one.lower = {0.0, 0.0};
    one.upper = {0.2, 0.2};
    one.line = LineStyle::dotted;
    one.marker = MarkerStyle::diamond;
    one.colour = 3;
    PlotSeries two;
    two.csv = "run/history.csv";
    two.x_column = "time";
    two.y_column = "mean_stress";
    spec.series = {one, two};
    const PlotSpec back = plot_spec_from_json(plot_spec_to_json(spec), "test");
    EXPECT_EQ(back.title, spec.title);
    EXPECT_TRUE(back.x.logarithmic);
    EXPECT_EQ(back.x.min, 0.1);
    EXPECT_FALSE(back.x.max);
    EXPECT_EQ(back.legend, "right");
    ASSERT_EQ(back.series.size(), 2U);
    EXPECT_EQ(back.series[0].x, one.x);
    EXPECT_EQ(back.series[0].y[0], 0.1);
    EXPECT_TRUE(std::isnan(back.series[0].y[1]));
    EXPECT_EQ(back.series[0].upper, one.upper);
    EXPECT_EQ(back.series[0].line, LineStyle::dotted);
    EXPECT_EQ(back.series[0].marker, MarkerStyle::diamond);
    EXPECT_EQ(back.series[0].colour, 3);
    EXPECT_EQ(back.series[1].csv, "run/history.csv");
    EXPECT_EQ(back.series[1].y_column, "mean_stress");
}

TEST(PlotSpecTest, MistakesAreNamed) {
    EXPECT_NE(input_error("{").find("spec.json: not JSON"), std::string::npos);
    EXPECT_NE(input_error(R"({"titel": "a"})").find("unknown key 'titel'"), std::string::npos);
    EXPECT_NE(input_error("{}").find("series: at least one"), std::string::npos);
    EXPECT_NE(input_error(R"({"series": [{"x": [1, 2], "y": [1]}]})").find("series[0]: x has 2"),
              std::string::npos);
    EXPECT_NE(input_error(R"({"series": [{"x": [1], "y": ["1"]}]})").find("series[0].y"), std::string::npos);
    EXPECT_NE(input_error(R"({"series": [{"x": [1], "y": [1], "line": "wavy"}]})").find("'wavy' is none of"),
              std::string::npos);
    EXPECT_NE(input_error(R"({"x": {"log": true, "min": -1}, "series": []})").find("needs min and max > 0"),
              std::string::npos);
    EXPECT_NE(input_error(R"({"width": 10, "series": [{"x": [1], "y": [1]}]})").find("200 to 8000"),
              std::string::npos);
}

PlotSpec spec_of(std::vector<double> x, std::vector<double> y) {
    PlotSpec spec;
    spec.series.emplace_back();
    spec.series[0].x = std::move(x);
    spec.series[0].y = std::move(y);
    return spec;
}

TEST(PlotDataTest, LogarithmicAxesDropWhatTheyCannotShow) {
    PlotSpec spec = spec_of({1.0, 2.0, 3.0}, {0.0, -1.0, 10.0});
    spec.y.logarithmic = true;
    load_plot_data(spec, ".");
    EXPECT_TRUE(std::isnan(spec.series[0].y[0]));
    EXPECT_TRUE(std::isnan(spec.series[0].y[1]));
    EXPECT_GT(y_range(spec).min, 0.0);
    PlotSpec noise = spec_of({1.0, 2.0, 3.0}, {1e-17, 1e-3, 0.1});
    noise.y.logarithmic = true;
    PlotSpec wanted = noise;
    wanted.y.min = 1e-18;
    load_plot_data(noise, ".");
    load_plot_data(wanted, ".");
    EXPECT_GT(y_range(noise).min, 1e-4);
    EXPECT_EQ(wanted.series[0].y[0], 1e-17);
    PlotSpec nothing = spec_of({1.0}, {-1.0});
    nothing.y.logarithmic = true;
    EXPECT_THROW(load_plot_data(nothing, "."), InputError);
}

TEST(PlotDataTest, RangesHoldTheDataAndWhatIsGiven) {
    PlotSpec spec = spec_of({0.8, 0.9}, {1.0, 5.0});
    EXPECT_LT(x_range(spec).min, 0.8);
    EXPECT_GT(x_range(spec).min, 0.78);
    EXPECT_EQ(y_range(spec).min, 0.0);
    EXPECT_GT(y_range(spec).max, 5.0);
    spec.y.max = 3.0;
    EXPECT_EQ(y_range(spec).max, 3.0);
    spec.series[0].upper = {9.0, 9.0};
    spec.y.max.reset();
    EXPECT_GT(y_range(spec).max, 9.0);
    EXPECT_GT(y_range(spec_of({1.0}, {2.0})).max, 2.0);
    EXPECT_LT(x_range(spec_of({1.0}, {2.0})).min, 1.0);
}

TEST(PlotDataTest, LegendGoesWhereTheDataAreNot) {
    EXPECT_EQ(emptiest_corner(spec_of({0, 1, 2, 3, 4}, {0, 1, 2, 3, 4}), 0.3, 0.3), "top_left");
    EXPECT_EQ(emptiest_corner(spec_of({0, 1, 2, 3, 4}, {4, 3, 2, 1, 0}), 0.3, 0.3), "top_right");
}

TEST(CsvTableTest, ReadsAndRefuses) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "t.csv";
    std::ofstream(path) << "# comment\ntime,\"value\"\r\n0,1e-3\n1, nan\n2,\n";
    const CsvTable table(path);
    EXPECT_TRUE(table.has("value"));
    ASSERT_EQ(table.column("value").size(), 3U);
    EXPECT_EQ(table.column("value")[0], 1e-3);
    EXPECT_TRUE(std::isnan(table.column("value")[1]));
    EXPECT_TRUE(std::isnan(table.column("value")[2]));
    EXPECT_THROW(table.column("stress"), InputError);
    std::ofstream(path) << "a,b\n1,2\n3\n";
    EXPECT_THROW(CsvTable{path}, InputError);
    std::ofstream(path) << "a,b\n1,x2\n";
    EXPECT_THROW(CsvTable{path}, InputError);
    EXPECT_THROW(CsvTable{folder.path() / "none.csv"}, InputError);
}

}  // namespace
}  // namespace softgrain
