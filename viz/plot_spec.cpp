#include "viz/plot_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>

#include "common/errors.hpp"

namespace softgrain {
namespace {

using nlohmann::json;

constexpr std::array<std::string_view, 4> line_names{"none", "solid", "dashed", "dotted"};
constexpr std::array<std::string_view, 6> marker_names{"none",    "circle", "square",
                                                       "diamond", "cross",  "plus"};
constexpr std::array<std::string_view, 7> legend_names{"auto",      "none",        "right",       "top_left",
                                                       "top_right", "bottom_left", "bottom_right"};

json numbers_to_json(const std::vector<double>& values) {
    json array = json::array();
    for (const double v : values) array.push_back(std::isfinite(v) ? json(v) : json(nullptr));
    return array;
}

json axis_to_json(const PlotAxis& axis) {
    json j{{"label", axis.label}};
    if (axis.logarithmic) j["log"] = true;
    if (axis.min) j["min"] = *axis.min;
    if (axis.max) j["max"] = *axis.max;
    return j;
}

json series_to_json(const PlotSeries& series) {
    json j{{"label", series.label},
           {"line", line_names[static_cast<std::size_t>(series.line)]},
           {"marker", marker_names[static_cast<std::size_t>(series.marker)]},
           {"width", series.width}};
    if (series.colour) j["colour"] = *series.colour;
    if (!series.csv.empty()) {
        j["csv"] = series.csv.string();
        j["x_column"] = series.x_column;
        j["y_column"] = series.y_column;
        if (!series.lower_column.empty()) j["lower_column"] = series.lower_column;
        if (!series.upper_column.empty()) j["upper_column"] = series.upper_column;
    } else {
        j["x"] = numbers_to_json(series.x);
        j["y"] = numbers_to_json(series.y);
        if (!series.lower.empty()) j["lower"] = numbers_to_json(series.lower);
        if (!series.upper.empty()) j["upper"] = numbers_to_json(series.upper);
    }
    return j;
}

/// One JSON object being read: names the place in messages and refuses keys that nobody asked for.
class ObjectReader {
  public:
    ObjectReader(const json& object, std::string place, std::initializer_list<std::string_view> keys)
        : object_(object), place_(std::move(place)) {
        if (!object.is_object()) throw InputError(place_ + ": must be a JSON object");
        for (const auto& item : object.items())
            if (std::find(keys.begin(), keys.end(), item.key()) == keys.end())
                throw InputError(fmt::format("{}: unknown key '{}'; the keys are {}", place_, item.key(),
                                             fmt::join(keys, ", ")));
    }

    bool has(const char* key) const { return object_.contains(key); }
    const json& at(const char* key) const { return object_.at(key); }

    template <typename T>
    void read(const char* key, T& value) const {
        if (!has(key)) return;
        try {
            value = object_.at(key).get<T>();
        } catch (const json::exception&) {
            throw InputError(fmt::format("{}.{}: wrong type of value", place_, key));
        }
    }
    void read_optional(const char* key, std::optional<double>& value) const {
        double number = 0.0;
        read(key, number);
        if (has(key)) value = number;
    }
    /// null stands for nan.
    void read_numbers(const char* key, std::vector<double>& values) const {
        if (!has(key)) return;
        const json& array = object_.at(key);
        if (!array.is_array()) throw InputError(fmt::format("{}.{}: must be an array", place_, key));
        for (const json& v : array) {
            if (!v.is_number() && !v.is_null())
                throw InputError(fmt::format("{}.{}: must hold numbers or null", place_, key));
            values.push_back(v.is_null() ? std::numeric_limits<double>::quiet_NaN() : v.get<double>());
        }
    }
    template <typename Names>
    std::size_t read_choice(const char* key, const Names& names, std::size_t otherwise) const {
        std::string text;
        read(key, text);
        if (!has(key)) return otherwise;
        const auto found = std::find(names.begin(), names.end(), text);
        if (found == names.end())
            throw InputError(
                fmt::format("{}.{}: '{}' is none of {}", place_, key, text, fmt::join(names, ", ")));
        return static_cast<std::size_t>(found - names.begin());
    }
    const std::string& place() const { return place_; }

  private:
    const json& object_;
    std::string place_;
};

PlotAxis axis_from_json(const json& j, const std::string& place) {
    const ObjectReader reader(j, place, {"label", "log", "min", "max"});
    PlotAxis axis;
    reader.read("label", axis.label);
    reader.read("log", axis.logarithmic);
    reader.read_optional("min", axis.min);
    reader.read_optional("max", axis.max);
    if (axis.min && axis.max && *axis.min >= *axis.max)
        throw InputError(place + ": min must be less than max");
    if (axis.logarithmic && ((axis.min && *axis.min <= 0.0) || (axis.max && *axis.max <= 0.0)))
        throw InputError(place + ": a logarithmic axis needs min and max > 0");
    return axis;
}

void check_series(const PlotSeries& series, const std::string& place) {
    const bool inline_numbers = !series.x.empty() || !series.y.empty();
    if (series.csv.empty() ? !inline_numbers : inline_numbers)
        throw InputError(place + ": needs either x and y, or csv with x_column and y_column");
    if (!series.csv.empty() && (series.x_column.empty() || series.y_column.empty()))
        throw InputError(place + ": csv needs x_column and y_column");
    if (series.x.size() != series.y.size())
        throw InputError(
            fmt::format("{}: x has {} values and y {}", place, series.x.size(), series.y.size()));
    if (series.lower.size() != series.upper.size() ||
        (!series.lower.empty() && series.lower.size() != series.x.size()) ||
        series.lower_column.empty() != series.upper_column.empty())
        throw InputError(place + ": a band needs lower and upper, each as long as x");
    if (series.colour && *series.colour < 0) throw InputError(place + ".colour: must be >= 0");
    if (!(series.width > 0.0)) throw InputError(place + ".width: must be > 0");
}

PlotSeries series_from_json(const json& j, const std::string& place) {
    const ObjectReader reader(j, place,
                              {"label", "x", "y", "csv", "x_column", "y_column", "lower", "upper",
                               "lower_column", "upper_column", "line", "marker", "width", "colour"});
    PlotSeries series;
    reader.read("label", series.label);
    std::string csv;
    reader.read("csv", csv);
    series.csv = csv;
    reader.read("x_column", series.x_column);
    reader.read("y_column", series.y_column);
    reader.read("lower_column", series.lower_column);
    reader.read("upper_column", series.upper_column);
    reader.read_numbers("x", series.x);
    reader.read_numbers("y", series.y);
    reader.read_numbers("lower", series.lower);
    reader.read_numbers("upper", series.upper);
    series.line = static_cast<LineStyle>(reader.read_choice("line", line_names, 1));
    series.marker = static_cast<MarkerStyle>(reader.read_choice("marker", marker_names, 0));
    reader.read("width", series.width);
    int colour = 0;
    reader.read("colour", colour);
    if (reader.has("colour")) series.colour = colour;
    check_series(series, place);
    return series;
}

}  // namespace

std::string plot_spec_to_json(const PlotSpec& spec) {
    json j{{"title", spec.title},   {"x", axis_to_json(spec.x)}, {"y", axis_to_json(spec.y)},
           {"legend", spec.legend}, {"width", spec.width},       {"height", spec.height}};
    j["series"] = json::array();
    for (const PlotSeries& series : spec.series) j["series"].push_back(series_to_json(series));
    return j.dump(1) + "\n";
}

PlotSpec plot_spec_from_json(std::string_view text, const std::string& source) {
    json j;
    try {
        j = json::parse(text);
    } catch (const json::exception& error) {
        throw InputError(fmt::format("{}: not JSON: {}", source, error.what()));
    }
    const ObjectReader reader(j, source, {"title", "x", "y", "series", "legend", "width", "height"});
    PlotSpec spec;
    reader.read("title", spec.title);
    reader.read("width", spec.width);
    reader.read("height", spec.height);
    spec.legend = legend_names[reader.read_choice("legend", legend_names, 0)];
    if (reader.has("x")) spec.x = axis_from_json(reader.at("x"), source + ": x");
    if (reader.has("y")) spec.y = axis_from_json(reader.at("y"), source + ": y");
    for (const int extent : {spec.width, spec.height})
        if (extent < 200 || extent > 8000)
            throw InputError(source + ": width and height must be 200 to 8000 pixels");
    if (!reader.has("series") || !reader.at("series").is_array() || reader.at("series").empty())
        throw InputError(source + ": series: at least one is needed");
    std::size_t index = 0;
    for (const json& one : reader.at("series"))
        spec.series.push_back(series_from_json(one, fmt::format("{}: series[{}]", source, index++)));
    return spec;
}

}  // namespace softgrain
