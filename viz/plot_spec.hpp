#pragma once
// A line plot as plain data, and its JSON form (viz/README.md describes the keys).
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace softgrain {

struct PlotAxis {
    std::string label;  ///< with its unit
    bool logarithmic = false;
    std::optional<double> min, max;  ///< without them, the range of the data
};

enum class LineStyle { none, solid, dashed, dotted };
enum class MarkerStyle { none, circle, square, diamond, cross, plus };

/// One curve: either inline numbers, or two columns of a CSV file with one header line. nan leaves a gap.
struct PlotSeries {
    std::string label;          ///< "" keeps it out of the legend
    std::vector<double> x, y;   ///< [n]
    std::filesystem::path csv;  ///< used if not empty; relative to the folder of the spec file
    std::string x_column, y_column;
    std::vector<double> lower, upper;        ///< [n] a shaded band around the curve, or empty
    std::string lower_column, upper_column;  ///< the band's columns, or empty
    LineStyle line = LineStyle::solid;
    MarkerStyle marker = MarkerStyle::none;
    double width = 1.0;         ///< of the line, relative
    std::optional<int> colour;  ///< number in the palette; without it, the series' own number
};

struct PlotSpec {
    std::string title;
    PlotAxis x, y;
    std::vector<PlotSeries> series;
    std::string legend = "auto";  ///< auto, none, right, top_left, top_right, bottom_left, bottom_right
    int width = 1600;             ///< [pixels]
    int height = 1200;            ///< [pixels]
};

std::string plot_spec_to_json(const PlotSpec& spec);

/// `source` names the text in messages. Throws InputError: syntax, unknown key, wrong type, missing data.
PlotSpec plot_spec_from_json(std::string_view text, const std::string& source);

}  // namespace softgrain
