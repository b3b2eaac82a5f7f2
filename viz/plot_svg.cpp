#include "viz/plot_svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

#include "viz/axis_ticks.hpp"
#include "viz/markup.hpp"
#include "viz/plot_data.hpp"
#include "viz/plot_look.hpp"

namespace softgrain {
namespace {

constexpr double letter = 0.62;     ///< mean width of a letter of DejaVu Sans, times its size
constexpr double long_tick = 0.35;  ///< times the font, as all below
constexpr double short_tick = 0.2;
constexpr double tick_room = 0.6;  ///< between an axis and its numbers
constexpr double legend_row = 1.35;
constexpr double legend_inset = 0.6;

struct Point {
    double x, y;
};

std::string px(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

std::string colour_text(const std::array<std::uint8_t, 4>& c) {
    return fmt::format("#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
}

std::string grey(std::uint8_t level) {
    return colour_text({level, level, level, 255});
}

double count_letters(std::string_view text) {
    return static_cast<double>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

/// Width of a tick's text, times its size.
double width_of(const AxisTick& tick) {
    const double all = letter * count_letters(tick.mantissa);
    return tick.power
               ? all + letter * (2.0 + 0.7 * static_cast<double>(fmt::format("{}", *tick.power).size()))
               : all;
}

std::string tick_markup(const AxisTick& tick, double size) {
    if (!tick.power) return tick.mantissa;
    return fmt::format("{}10<tspan dy=\"{}\" font-size=\"{}\">{}{}</tspan>", tick.mantissa, px(-0.4 * size),
                       px(0.7 * size), *tick.power < 0 ? "\u2212" : "", std::abs(*tick.power));
}

/// Runs of neighbours that are all finite, as [begin, end).
std::vector<std::pair<std::size_t, std::size_t>> runs(const std::vector<Point>& points) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    const auto finite = [](const Point& p) { return std::isfinite(p.x) && std::isfinite(p.y); };
    for (std::size_t k = 0; k < points.size(); ++k) {
        if (!finite(points[k])) continue;
        const std::size_t begin = k;
        while (k < points.size() && finite(points[k])) ++k;
        found.emplace_back(begin, k);
    }
    return found;
}

class Drawing {
  public:
    Drawing(const PlotSpec& spec, double letters)
        : spec_(spec),
          font_(letters * look::font_size(spec)),
          x_(x_range(spec)),
          y_(y_range(spec)),
          x_ticks_(axis_ticks(spec.x, x_)),
          y_ticks_(axis_ticks(spec.y, y_)) {
        double widest = 0.0;
        for (const AxisTick& tick : y_ticks_) widest = std::max(widest, width_of(tick));
        const double small = look::small_text * font_;
        left_ = tick_room * font_ + widest * small + (spec.y.label.empty() ? 0.6 : 2.2) * font_;
        top_ = (spec.title.empty() ? 1.0 : 3.0) * font_;
        width_ = spec.width - left_ - (1.4 + (spec.legend == "right" ? legend_width() / font_ : 0.0)) * font_;
        height_ = spec.height - top_ - (spec.x.label.empty() ? 2.0 : 3.4) * font_;
    }

    std::string text() const {
        std::string out = fmt::format(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
            "role=\"img\" font-family=\"'DejaVu Sans', Verdana, Arial, sans-serif\" font-size=\"{2}\" "
            "fill=\"#000\">\n",
            spec_.width, spec_.height, px(font_));
        if (!spec_.title.empty()) out += fmt::format("<title>{}</title>\n", escape_markup(spec_.title));
        out += fmt::format("<rect width=\"{}\" height=\"{}\" fill=\"#fff\"/>\n", spec_.width, spec_.height);
        out += axes();
        out += fmt::format("<svg x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" overflow=\"hidden\">\n",
                           px(left_), px(top_), px(width_), px(height_));
        std::size_t number = 0;
        for (const PlotSeries& series : spec_.series) out += band(series, number++);
        number = 0;
        for (const PlotSeries& series : spec_.series) out += curve(series, number++);
        out += "</svg>\n";
        number = 0;
        for (const PlotSeries& series : spec_.series) out += markers(series, number++);
        return out + titles() + legend() + "</svg>\n";
    }

  private:
    /// Within the plot area.
    Point at(double x, double y) const {
        return {width_ * place_on_axis(x, x_, spec_.x.logarithmic),
                height_ * (1.0 - place_on_axis(y, y_, spec_.y.logarithmic))};
    }
    std::vector<Point> points(const std::vector<double>& x, const std::vector<double>& y) const {
        std::vector<Point> all;
        for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) all.push_back(at(x[k], y[k]));
        return all;
    }
    double bottom() const { return top_ + height_; }

    std::string axes() const {
        const double small = look::small_text * font_;
        const std::string pen = fmt::format("stroke-width=\"{}\"", px(look::axis_width * font_));
        std::string grid, marks, numbers;
        const auto length = [&](const AxisTick& tick) {
            return (tick.is_minor() ? short_tick : long_tick) * font_;
        };
        for (const AxisTick& tick : x_ticks_) {
            const double x = left_ + tick.place * width_;
            grid += fmt::format("M{} {}V{}", px(x), px(top_), px(bottom()));
            marks += fmt::format("M{} {}v{}", px(x), px(bottom()), px(length(tick)));
            if (tick.is_minor()) continue;
            numbers += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", px(x),
                                   px(bottom() + tick_room * font_ + 0.85 * small), tick_markup(tick, small));
        }
        for (const AxisTick& tick : y_ticks_) {
            const double y = bottom() - tick.place * height_;
            grid += fmt::format("M{} {}H{}", px(left_), px(y), px(left_ + width_));
            marks += fmt::format("M{} {}h{}", px(left_), px(y), px(-length(tick)));
            if (tick.is_minor()) continue;
            numbers +=
                fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"end\">{}</text>\n",
                            px(left_ - tick_room * font_), px(y + 0.36 * small), tick_markup(tick, small));
        }
        return fmt::format(
            "<path d=\"{}\" stroke=\"{}\" fill=\"none\"/>\n"
            "<path d=\"{}M{} {}V{}H{}\" stroke=\"#000\" {} fill=\"none\"/>\n<g font-size=\"{}\">\n{}</g>\n",
            grid, grey(look::grid_grey), marks, px(left_), px(top_), px(bottom()), px(left_ + width_), pen,
            px(small), numbers);
    }

    std::string band(const PlotSeries& series, std::size_t number) const {
        const auto low = points(series.x, series.lower), high = points(series.x, series.upper);
        std::vector<Point> both;  // finite where both are
        for (std::size_t k = 0; k < low.size(); ++k) both.push_back({low[k].x, low[k].y + high[k].y});
        std::string path;
        for (const auto& [begin, end] : runs(both)) {
            for (std::size_t k = begin; k < end; ++k)
                path += fmt::format("{}{} {}", k == begin ? "M" : "L", px(high[k].x), px(high[k].y));
            for (std::size_t k = end; k-- > begin;) path += fmt::format("L{} {}", px(low[k].x), px(low[k].y));
            path += "Z";
        }
        if (path.empty()) return {};
        return fmt::format("<path d=\"{}\" fill=\"{}\" fill-opacity=\"{:.2f}\"/>\n", path,
                           colour_text(look::colour_of(series, number)), look::band_opacity / 255.0);
    }

    std::string curve(const PlotSeries& series, std::size_t number) const {
        const auto all = points(series.x, series.y);
        const std::string colour = colour_text(look::colour_of(series, number));
        std::string path, dots;
        for (const auto& [begin, end] : runs(all)) {
            for (std::size_t k = begin; k < end; ++k)
                path += fmt::format("{}{} {}", k == begin ? "M" : "L", px(all[k].x), px(all[k].y));
            if (end - begin == 1 && series.line != LineStyle::none && series.marker == MarkerStyle::none)
                dots += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\" fill=\"{}\"/>\n", px(all[begin].x),
                                    px(all[begin].y), px(look::line_width * font_ * series.width), colour);
        }
        return (path.empty() ? "" : stroke(series, path, colour)) + dots;
    }

    /// Not cut at the edge of the plot area.
    std::string markers(const PlotSeries& series, std::size_t number) const {
        const std::string colour = colour_text(look::colour_of(series, number));
        const auto within = [](double at, double length) { return at >= -0.01 && at <= length + 0.01; };
        std::string out;
        for (const Point& p : points(series.x, series.y))
            if (within(p.x, width_) && within(p.y, height_))
                out += marker(series.marker, {left_ + p.x, top_ + p.y}, colour);
        return out;
    }

    std::string stroke(const PlotSeries& series, const std::string& path, const std::string& colour) const {
        if (series.line == LineStyle::none) return {};
        const double width = look::line_width * font_ * series.width;
        std::string dashes;
        if (series.line == LineStyle::dashed)
            dashes = fmt::format(" stroke-dasharray=\"{} {}\"", px(4.5 * width), px(3.5 * width));
        if (series.line == LineStyle::dotted)
            dashes = fmt::format(" stroke-dasharray=\"0 {}\"", px(2.4 * width));
        return fmt::format(
            "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linejoin=\"round\" "
            "stroke-linecap=\"round\"{}/>\n",
            path, colour, px(width), dashes);
    }

    std::string marker(MarkerStyle style, const Point& p, const std::string& colour) const {
        const double r = 0.5 * look::marker_size * font_;
        const auto filled = [&](const std::string& shape) {
            return fmt::format("<{} fill=\"{}\"/>\n", shape, colour);
        };
        const auto lines = [&](const std::string& path) {
            return fmt::format("<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\"/>\n", path, colour,
                               px(look::line_width * font_));
        };
        switch (style) {
            case MarkerStyle::none:
                return {};
            case MarkerStyle::circle:
                return filled(fmt::format("circle cx=\"{}\" cy=\"{}\" r=\"{}\"", px(p.x), px(p.y), px(r)));
            case MarkerStyle::square:
                return filled(fmt::format("rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"", px(p.x - r),
                                          px(p.y - r), px(2.0 * r), px(2.0 * r)));
            case MarkerStyle::diamond:
                return filled(fmt::format("path d=\"M{0} {1}l{2} {2}l{3} {2}l{3} {3}Z\"", px(p.x),
                                          px(p.y - 1.3 * r), px(1.3 * r), px(-1.3 * r)));
            case MarkerStyle::cross:
                return lines(fmt::format("M{0} {1}l{2} {2}m0 {3}l{3} {2}", px(p.x - r), px(p.y - r),
                                         px(2.0 * r), px(-2.0 * r)));
            case MarkerStyle::plus:
                return lines(fmt::format("M{} {}h{}M{} {}v{}", px(p.x - r), px(p.y), px(2.0 * r), px(p.x),
                                         px(p.y - r), px(2.0 * r)));
        }
        return {};
    }

    std::string titles() const {
        std::string out;
        if (!spec_.title.empty())
            out += fmt::format(
                "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\" font-weight=\"bold\" "
                "font-size=\"{}\">{}</text>\n",
                px(spec_.width / 2.0), px(1.9 * font_), px(look::title_text * font_),
                escape_markup(spec_.title));
        const double middle = left_ + 0.5 * width_;
        if (!spec_.x.label.empty())
            out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", px(middle),
                               px(spec_.height - 0.7 * font_), escape_markup(spec_.x.label));
        if (!spec_.y.label.empty())
            out += fmt::format(
                "<text transform=\"translate({} {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                px(1.4 * font_), px(top_ + 0.5 * height_), escape_markup(spec_.y.label));
        return out;
    }

    double legend_width() const {
        double widest = 0.0;
        for (const PlotSeries& series : spec_.series) widest = std::max(widest, count_letters(series.label));
        return (3.0 * look::legend_padding + look::legend_symbol + letter * look::small_text * widest) *
               font_;
    }

    std::string legend() const {
        const auto rows = static_cast<double>(std::count_if(
            spec_.series.begin(), spec_.series.end(), [](const PlotSeries& s) { return !s.label.empty(); }));
        if (spec_.legend == "none" || rows == 0.0) return {};
        const double w = legend_width();
        const double h = (2.0 * look::legend_padding + legend_row * rows) * font_;
        const double inset = legend_inset * font_;
        const std::string corner = spec_.legend == "auto"
                                       ? emptiest_corner(spec_, (w + inset) / width_, (h + inset) / height_)
                                       : spec_.legend;
        double x = corner.ends_with("left") ? left_ + inset : left_ + width_ - inset - w;
        if (corner == "right") x = left_ + width_ + inset;
        double y = corner.starts_with("bottom") ? bottom() - inset - h : top_ + inset;
        std::string out = fmt::format(
            "<g font-size=\"{}\">\n<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"#fff\" "
            "fill-opacity=\"{:.2f}\" stroke=\"{}\"/>\n",
            px(look::small_text * font_), px(x), px(y), px(w), px(h), look::legend_opacity / 255.0,
            grey(look::legend_edge_grey));
        std::size_t number = 0;
        x += look::legend_padding * font_;
        y += (look::legend_padding + 0.5 * legend_row) * font_;
        for (const PlotSeries& series : spec_.series) {
            const std::string colour = colour_text(look::colour_of(series, number++));
            if (series.label.empty()) continue;
            const double symbol = look::legend_symbol * font_;
            out += stroke(series, fmt::format("M{} {}h{}", px(x), px(y), px(symbol)), colour);
            out += marker(series.marker, {x + 0.5 * symbol, y}, colour);
            out += fmt::format("<text x=\"{}\" y=\"{}\">{}</text>\n",
                               px(x + symbol + look::legend_padding * font_), px(y + 0.33 * font_),
                               escape_markup(series.label));
            y += legend_row * font_;
        }
        return out + "</g>\n";
    }

    const PlotSpec& spec_;
    double font_;
    PlotRange x_, y_;
    std::vector<AxisTick> x_ticks_, y_ticks_;
    double left_ = 0.0, top_ = 0.0, width_ = 0.0, height_ = 0.0;  ///< of the plot area [pixels]
};

}  // namespace

std::string plot_svg(const PlotSpec& spec, double letters) {
    return Drawing(spec, letters).text();
}

}  // namespace softgrain
