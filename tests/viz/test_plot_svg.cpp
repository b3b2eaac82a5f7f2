// Plots as SVG, read back with VTK's XML parser.
#include <gtest/gtest.h>
#include <vtkSmartPointer.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "common/errors.hpp"
#include "hand_made_grains.hpp"
#include "viz/axis_ticks.hpp"
#include "viz/client.hpp"
#include "viz/markup.hpp"
#include "viz/plot_svg.hpp"
#include "viz/render/plot_command.hpp"

namespace softgrain {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

using Element = vtkSmartPointer<vtkXMLDataElement>;

Element parsed(const std::string& text) {
    Element root;
    root.TakeReference(vtkXMLUtilities::ReadElementFromString(text.c_str()));
    return root;
}

std::string attribute(vtkXMLDataElement& element, const char* name) {
    const char* value = element.GetAttribute(name);
    return value == nullptr ? "" : value;
}

/// All elements of this name, wherever they are.
std::vector<vtkXMLDataElement*> all(vtkXMLDataElement& root, const std::string& name) {
    std::vector<vtkXMLDataElement*> found;
    for (int k = 0; k < root.GetNumberOfNestedElements(); ++k) {
        vtkXMLDataElement* child = root.GetNestedElement(k);
        if (child->GetName() == name) found.push_back(child);
        for (vtkXMLDataElement* deeper : all(*child, name)) found.push_back(deeper);
    }
    return found;
}

std::ptrdiff_t count(const std::string& text, const std::string& word) {
    std::ptrdiff_t n = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
    return n;
}

PlotSpec two_curves() {
    PlotSpec spec;
    spec.title = "a <title> & \"more\"";
    spec.x.label = "x [m]";
    spec.y.label = "y <N/m>";
    PlotSeries one;
    one.label = "one & <two>";
    one.x = {0.0, 1.0, 2.0, 3.0, 4.0};
    one.y = {1.0, 2.0, nan, 4.0, 5.0};
    PlotSeries two;
    two.label = "band";
    two.x = one.x;
    two.y = {2.0, 3.0, 4.0, 5.0, 6.0};
    two.lower = {1.5, 2.5, 3.5, 4.5, 5.5};
    two.upper = {2.5, 3.5, 4.5, 5.5, 6.5};
    two.line = LineStyle::dashed;
    two.marker = MarkerStyle::circle;
    spec.series = {one, two};
    return spec;
}

TEST(PlotSvg, IsXmlWithEscapedText) {
    const std::string text = plot_svg(two_curves());
    const Element root = parsed(text);
    ASSERT_NE(root, nullptr) << text;
    EXPECT_STREQ(root->GetName(), "svg");
    EXPECT_EQ(attribute(*root, "viewBox"), "0 0 1600 1200");
    EXPECT_EQ(count(text, "a &lt;title&gt; &amp; &quot;more&quot;</text>"), 1);
    EXPECT_EQ(count(text, "y &lt;N/m&gt;</text>"), 1);
    EXPECT_EQ(count(text, "one &amp; &lt;two&gt;</text>"), 1);
    EXPECT_EQ(count(text, "nan"), 0);
    EXPECT_EQ(count(text, " id="), 0);
}

// In the plot area the first path is the band, the second and third are the curves.
TEST(PlotSvg, GapBandDashesAndMarkers) {
    const Element root = parsed(plot_svg(two_curves()));
    const auto areas = all(*root, "svg");
    ASSERT_EQ(areas.size(), 1U);
    const auto paths = all(*areas[0], "path");
    ASSERT_EQ(paths.size(), 3U);
    const std::string band = attribute(*paths[0], "d");
    EXPECT_EQ(count(band, "L"), 9);
    EXPECT_EQ(count(band, "Z"), 1);
    EXPECT_EQ(attribute(*paths[0], "fill"), "#d55e00");
    const std::string broken = attribute(*paths[1], "d");
    EXPECT_EQ(count(broken, "M"), 2);
    EXPECT_EQ(count(broken, "L"), 2);
    EXPECT_EQ(attribute(*paths[1], "stroke"), "#0072b2");
    EXPECT_EQ(attribute(*paths[1], "stroke-dasharray"), "");
    EXPECT_NE(attribute(*paths[2], "stroke-dasharray"), "");
    EXPECT_EQ(all(*root, "circle").size(), 5U + 1U);  // and one in the legend
}

// A curve in the middle of given ranges: the point (1, 10) lies a quarter of the way along x, half-way up log
// y.
TEST(PlotSvg, PointsLieWhereTheAxesSay) {
    PlotSpec spec;
    spec.x.min = 0.0;
    spec.x.max = 4.0;
    spec.y = {"", true, 1.0, 100.0};
    spec.series.emplace_back();
    spec.series[0].x = {1.0, 4.0};
    spec.series[0].y = {10.0, 100.0};
    const Element root = parsed(plot_svg(spec));
    vtkXMLDataElement& area = *all(*root, "svg").at(0);
    double x = 0.0, y = 0.0, x_end = 0.0, y_end = -1.0;
    ASSERT_EQ(std::sscanf(attribute(*all(area, "path").at(0), "d").c_str(), "M%lf %lfL%lf %lf", &x, &y,
                          &x_end, &y_end),
              4);
    const double width = std::stod(attribute(area, "width")), height = std::stod(attribute(area, "height"));
    EXPECT_NEAR(x, 0.25 * width, 2e-3);  // three decimals are written
    EXPECT_NEAR(y, 0.5 * height, 2e-3);
    EXPECT_NEAR(x_end, width, 2e-3);
    EXPECT_NEAR(y_end, 0.0, 2e-3);
}

TEST(AxisTicks, LinearAreRoundNumbers) {
    const auto ticks = axis_ticks({}, {0.78, 0.96});
    ASSERT_EQ(ticks.size(), 4U);
    EXPECT_EQ(ticks[0].mantissa, "0.80");
    EXPECT_EQ(ticks[3].mantissa, "0.95");
    EXPECT_NEAR(ticks[0].place, 0.02 / 0.18, 1e-12);
    const auto small = axis_ticks({}, {-1.2e-5, 3e-5});
    EXPECT_EQ(small.front().mantissa, "\u22121\u00b7");
    EXPECT_EQ(small.front().power, -5);
    EXPECT_EQ(small[1].mantissa, "0");
}

TEST(AxisTicks, LogarithmicAreDecadesWithMinorOnes) {
    const PlotAxis axis{"", true, {}, {}};
    int named = 0, minor = 0;
    for (const AxisTick& tick : axis_ticks(axis, {0.9e-3, 1.1})) (tick.is_minor() ? minor : named) += 1;
    EXPECT_EQ(named, 4);       // 1e-3 to 1
    EXPECT_EQ(minor, 24 + 1);  // 8 in each decade and 0.9e-3
    std::string numbers;
    for (const AxisTick& tick : axis_ticks(axis, {0.0008, 0.03}))
        if (!tick.is_minor()) numbers += tick.mantissa + std::to_string(*tick.power) + " ";
    EXPECT_EQ(numbers, "-3 2\u00b7-3 5\u00b7-3 -2 2\u00b7-2 ");
    numbers.clear();
    for (const AxisTick& tick : axis_ticks(axis, {0.04, 1.1}))
        numbers += tick.is_minor() ? "" : tick.mantissa + " ";
    EXPECT_EQ(numbers, "0.05 0.1 0.2 0.5 1 ");
    numbers.clear();
    for (const AxisTick& tick : axis_ticks(axis, {0.025, 0.06})) numbers += tick.mantissa + " ";
    EXPECT_EQ(numbers, "0.03 0.04 0.05 0.06 ");
    named = 0;
    for (const AxisTick& tick : axis_ticks(axis, {1e-12, 1e12})) named += tick.is_minor() ? 0 : 1;
    EXPECT_LE(named, 9);
    EXPECT_GE(named, 5);
}

TEST(PlotSvg, EscapedMarkupHasNoControlCharacters) {
    EXPECT_EQ(escape_markup("<a href='x'>\"&\"\x01\n"), "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot; \n");
}

TEST(PlotSvg, TheEndingChooses) {
    const TemporaryFolder folder;
    const auto spec_file = folder.path() / "spec.json";
    std::ofstream(folder.path() / "t.csv") << "a,b\n0,1\n1,2\n";
    PlotSpec spec;
    spec.series.emplace_back();
    spec.series[0].csv = folder.path() / "t.csv";
    spec.series[0].x_column = "a";
    spec.series[0].y_column = "b";
    EXPECT_EQ(render_plot(spec, folder.path() / "spec.svg"), std::nullopt);
    draw_plot(spec_file, folder.path() / "again.svg");
    const auto content = [](const std::filesystem::path& path) {
        std::stringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    };
    EXPECT_EQ(content(folder.path() / "spec.svg"), content(folder.path() / "again.svg"));
    EXPECT_NE(parsed(content(folder.path() / "again.svg")), nullptr);
    try {
        draw_plot(spec_file, folder.path() / "x.gif");
        FAIL() << "no InputError";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("x.gif: must end in .png or .svg"), std::string::npos);
    }
}

}  // namespace
}  // namespace softgrain
