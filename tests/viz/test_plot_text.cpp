// A plot in letters.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "viz/plot_text.hpp"

namespace softgrain {
namespace {

PlotSpec spec_of(std::vector<double> x, std::vector<double> y) {
    PlotSpec spec;
    spec.x.label = "x";
    spec.y.label = "y [m]";
    spec.series.emplace_back();
    spec.series.back().x = std::move(x);
    spec.series.back().y = std::move(y);
    return spec;
}

TEST(PlotText, ALineGoesFromCornerToCorner) {
    EXPECT_EQ(plot_text(spec_of({0.0, 2.0}, {1.0, 10.0}), 7, 4),
              "y [m]\n"
              "10 |     **\n"
              "   |   **\n"
              "   | **\n"
              " 1 |*\n"
              "   +-------\n"
              "    0  x  2\n");
}

TEST(PlotText, WhatIsNotFiniteIsAGap) {
    const double nan = std::nan("");
    EXPECT_EQ(plot_text(spec_of({0.0, 1.0, 2.0, 3.0, 4.0}, {0.0, 0.0, nan, 1.0, 1.0}), 9, 2),
              "y [m]\n"
              "1 |      ***\n"
              "0 |***\n"
              "  +---------\n"
              "   0   x   4\n");
}

TEST(PlotText, AConstantAndNothingAtAll) {
    EXPECT_NE(plot_text(spec_of({1.0}, {5.0}), 9, 2).find('*'), std::string::npos);
    EXPECT_EQ(plot_text(spec_of({1.0}, {std::numeric_limits<double>::infinity()}), 9, 2), "");
    EXPECT_EQ(plot_text(PlotSpec{}, 9, 2), "");
}

TEST(PlotText, EverySeriesHasAMarkOfItsOwn) {
    PlotSpec spec = spec_of({0.0, 1.0}, {0.0, 0.0});
    spec.series.push_back(spec_of({0.0, 1.0}, {1.0, 1.0}).series.front());
    const std::string text = plot_text(spec, 4, 2);
    EXPECT_NE(text.find("|oooo"), std::string::npos) << text;
    EXPECT_NE(text.find("|****"), std::string::npos) << text;
}

}  // namespace
}  // namespace softgrain
