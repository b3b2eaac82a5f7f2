#include "viz/render/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace softgrain {
namespace {

constexpr double widest_line = 0.6;    ///< of a force, times the font
constexpr double tallest_panel = 1.4;  ///< times its width
constexpr Colour warning{183, 65, 0, 255};
constexpr double second_key = 7.0;  ///< distance between two keys of forces, times the font

/// Sizes of everything on the page [pixels].
struct Layout {
    double font, margin, left, gap, header, caption, footer;
    double panel_width, panel_height, scale;
    double height;
};

constexpr double line_height = 1.15, title_height = 1.6;  ///< of a caption, times the font

bool has_titles(const Sheet& sheet) {
    return !sheet.cells[0][0].title.empty();
}

Layout make_layout(const Sheet& sheet, const SheetScale& scale, int width) {
    const auto rows = static_cast<double>(sheet.cells.size());
    const auto columns = static_cast<double>(sheet.cells[0].size());
    Layout l{};
    l.font = columns > 1.0 ? width / std::max(76.0, 19.0 * columns) : width / 52.0;
    l.margin = 1.2 * l.font;
    l.left = sheet.row_labels.empty() ? 0.0 : 2.2 * l.font;
    l.gap = 1.6 * l.font;
    l.header = sheet.heading.empty() && sheet.column_labels.empty() ? 0.0 : 2.4 * l.font;
    l.caption = 3.2 * l.font;
    if (sheet.one_stage) l.caption += line_height * l.font;
    if (has_titles(sheet)) l.caption += title_height * l.font;
    l.footer = 6.0 * l.font;
    l.panel_width = (width - l.left - 2.0 * l.margin - (columns - 1.0) * l.gap) / columns;
    l.scale = std::min(l.panel_width / scale.extent.x(), tallest_panel * l.panel_width / scale.extent.y());
    l.panel_height = l.scale * scale.extent.y();
    l.height = l.margin + l.header + rows * (l.caption + l.panel_height + l.gap) + l.footer;
    return l;
}

std::string number_text(double value) {
    return fmt::format("{:.3g}", value);
}

/// A line over a panel, made smaller if it would run into its neighbours.
void draw_line(Page& page, const Layout& l, const Vec2& centre, const std::string& words, double size,
               bool bold, Colour colour) {
    const double room = l.panel_width;
    const double wide = text_width(words, size, bold);
    const double fitted = wide > room ? std::floor(size * room / wide) : size;
    page.text(centre, words, {fitted, Align::centre, Align::centre, false, bold, colour});
}

/// Lines from the panel upwards: stress, packing fraction, title.
void draw_caption(Page& page, const Sheet& sheet, const Cell& cell, double no_stress, const Layout& l,
                  double x, double y) {
    const Frame& frame = *cell.frame;
    const std::string time = fmt::format("time {:.4g} s", frame.time);
    std::vector<std::string> lines;
    const double stress = std::abs(frame.mean_stress) < no_stress ? 0.0 : frame.mean_stress;
    std::string last;
    if (std::isfinite(stress)) last = "mean stress " + number_text(stress) + " N/m";
    if (std::isfinite(frame.coordination_number))
        last += fmt::format("{}Z {:.2f}", last.empty() ? "" : ",  ", frame.coordination_number);
    lines.push_back(last);
    const bool has_packing_fraction = std::isfinite(frame.packing_fraction);
    if (has_packing_fraction && sheet.one_stage) lines.push_back(time);
    const std::string where =
        has_packing_fraction ? fmt::format("packing fraction {:.3f}", frame.packing_fraction) : time;
    lines.push_back(cell.ending.empty() ? where : cell.ending + " " + where);
    double height = y + 0.75 * l.font;
    for (const std::string& line : lines) {
        const bool is_warning = &line == &lines.back() && !cell.ending.empty();
        draw_line(page, l, {x, height}, line, l.font, false, is_warning ? warning : black);
        height += line_height * l.font;
    }
    if (!cell.title.empty())
        draw_line(page, l, {x, height + 0.2 * l.font}, cell.title, 1.25 * l.font, true, black);
}

/// A pointed end, for values beyond the scale.
void draw_point(Page& page, const Vec2& base, double height, double reach, Colour colour) {
    const std::vector<Vec2> corners{base, base + Vec2{reach, height / 2.0}, base + Vec2{0.0, height}};
    page.fill(corners, colour);
    page.stroke(corners, 1.5, black, false);
}

/// Every second of the round ticks, or fewer, if their texts would run into each other.
std::vector<double> ticks_with_room(const ColourRange& range, double width, double font) {
    std::vector<double> ticks = round_ticks(range.min, range.max);
    while (ticks.size() > 2) {
        const double spacing = ticks[1] - ticks[0];
        double widest = 0.0;
        for (const double tick : ticks)
            widest = std::max(widest, text_width(tick_text(tick, spacing), font, false));
        if (widest + 0.6 * font <= width * spacing / (range.max - range.min)) break;
        std::erase_if(ticks, [&](double tick) { return std::lround(tick / spacing) % 2 != 0; });
    }
    return ticks;
}

void draw_colour_bar(Page& page, const SheetScale& scale, const Layout& l, double x, double y, double width) {
    const double thickness = 1.1 * l.font;
    constexpr int steps = 256;
    const ColourRange& range = scale.colours;
    const auto colour_at = [&](double share) {
        return colour_of(range, range.min + share * (range.max - range.min));
    };
    for (int k = 0; k < steps; ++k)
        page.rectangle({x + width * k / steps, y}, {x + width * (k + 1) / steps, y + thickness},
                       colour_at((k + 0.5) / steps));
    if (scale.colours.below) draw_point(page, {x, y}, thickness, -thickness, colour_at(0.0));
    if (scale.colours.above) draw_point(page, {x + width, y}, thickness, thickness, colour_at(1.0));
    page.stroke(std::vector<Vec2>{{x, y}, {x + width, y}}, 1.5, black, false);
    page.stroke(std::vector<Vec2>{{x, y + thickness}, {x + width, y + thickness}}, 1.5, black, false);
    if (!scale.colours.below) page.stroke(std::vector<Vec2>{{x, y}, {x, y + thickness}}, 1.5, black, false);
    if (!scale.colours.above)
        page.stroke(std::vector<Vec2>{{x + width, y}, {x + width, y + thickness}}, 1.5, black, false);
    const auto ticks = ticks_with_room(range, width, l.font);
    const double spacing = ticks.size() > 1 ? ticks[1] - ticks[0] : range.max;
    for (const double tick : ticks) {
        const double at = x + width * scale.colours.fraction(tick);
        page.stroke(std::vector<Vec2>{{at, y}, {at, y - 0.3 * l.font}}, 1.5, black, false);
        page.text({at, y - 0.5 * l.font}, tick_text(tick, spacing), {l.font, Align::centre, Align::high});
    }
    std::string title = scale.field;
    std::replace(title.begin(), title.end(), '_', ' ');
    if (!scale.unit.empty()) title += " [" + scale.unit + "]";
    page.text({x + width / 2.0, y + thickness + 0.5 * l.font}, title, {l.font, Align::centre, Align::low});
}

void draw_scale_bar(Page& page, const SheetScale& scale, const Layout& l, double x, double y, double room) {
    const double metres = round_down(std::min(0.8 * room / l.scale, 0.5 * scale.extent.x()));
    const double length = metres * l.scale;
    const double middle = y + 0.55 * l.font;
    page.stroke(std::vector<Vec2>{{x, middle}, {x + length, middle}}, 0.22 * l.font, black, false);
    for (const double end : {x, x + length})
        page.stroke(std::vector<Vec2>{{end, middle - 0.4 * l.font}, {end, middle + 0.4 * l.font}},
                    0.12 * l.font, black, false);
    page.text({x + length / 2.0, y - 0.5 * l.font}, number_text(metres) + " m",
              {l.font, Align::centre, Align::high});
}

void draw_force_key(Page& page, const ForceScale& forces, const std::string& title, const Layout& l,
                    double right, double y) {
    const double length = 4.0 * l.font;
    const double middle = y + 0.55 * l.font;
    draw_chains(page, std::vector<Chain>{
                          {{{right - length, middle}, {right, middle}}, forces.widest_line * l.scale}});
    page.text({right, y - 0.5 * l.font}, number_text(forces.widest_force) + " N",
              {l.font, Align::high, Align::high});
    page.text({right, y + 1.6 * l.font}, title, {l.font, Align::high, Align::low});
}

void draw_force_keys(Page& page, const SheetScale& scale, const Layout& l, double right, double y) {
    const bool of_grains = scale.grain_forces.widest_force > 0.0;
    const bool of_parts = scale.part_forces.widest_force > 0.0;
    const bool both = of_grains && of_parts;
    if (of_parts) draw_force_key(page, scale.part_forces, both ? "of parts" : "normal force", l, right, y);
    if (of_grains)
        draw_force_key(page, scale.grain_forces, both ? "force of grains" : "normal force", l,
                       right - (both ? second_key * l.font : 0.0), y);
}

}  // namespace

Page lay_out_sheet(const Sheet& sheet, const SheetScale& wanted, int width) {
    const Layout l = make_layout(sheet, wanted, width);
    SheetScale scale = wanted;
    for (ForceScale* forces : {&scale.grain_forces, &scale.part_forces})
        forces->widest_line = std::min(forces->widest_line, widest_line * l.font / l.scale);
    Page page(width, static_cast<int>(std::lround(l.height)));
    const PanelScale panel{scale.field,        scale.colours,     l.scale,
                           scale.grain_forces, scale.part_forces, scale.window};
    const auto column_centre = [&](std::size_t c) {
        return l.margin + l.left + static_cast<double>(c) * (l.panel_width + l.gap) + l.panel_width / 2.0;
    };
    double y = l.height - l.margin - l.header;
    const TextStyle header{1.15 * l.font, Align::centre, Align::centre, false, true};
    page.text({column_centre(0), y + l.header / 2.0}, sheet.heading, header);
    for (std::size_t c = 0; c < sheet.column_labels.size(); ++c)
        page.text({column_centre(c), y + l.header / 2.0}, sheet.column_labels[c], header);
    for (std::size_t r = 0; r < sheet.cells.size(); ++r) {
        y -= l.caption + l.panel_height;
        for (std::size_t c = 0; c < sheet.cells[r].size(); ++c) {
            const Cell& cell = sheet.cells[r][c];
            const Vec2 centre{column_centre(c), y + l.panel_height / 2.0};
            draw_panel(page, *cell.frame, panel, centre);
            const double height = sheet.one_stage
                                      ? l.panel_height
                                      : l.scale * shown_extent(*cell.frame, scale.window).size().y();
            draw_caption(page, sheet, cell, scale.no_stress, l, centre.x(),
                         centre.y() + height / 2.0 + 0.3 * l.font);
        }
        if (!sheet.row_labels.empty())
            page.text({l.margin + 0.5 * l.font, y + l.panel_height / 2.0}, sheet.row_labels[r],
                      {1.25 * l.font, Align::centre, Align::centre, true, true});
        y -= l.gap;
    }
    const double bar = 0.46 * width;
    const double base = l.footer - 3.6 * l.font;
    draw_colour_bar(page, scale, l, (width - bar) / 2.0, base, bar);
    draw_scale_bar(page, scale, l, l.margin + l.left, base, 0.2 * width);
    draw_force_keys(page, scale, l, width - l.margin, base);
    return page;
}

}  // namespace softgrain
