#include "viz/render/panel.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

constexpr Colour outline_colour{45, 45, 45, 255};
constexpr Colour inside_grain{215, 215, 215, 255};  ///< behind the parts
constexpr double outline_share = 0.025;    ///< width of an outline, times the mean diameter of the grains
constexpr double thickest_outline = 1.4;   ///< [pixels]
constexpr double thinnest_outline = 0.12;  ///< not drawn if it would be thinner [pixels]
constexpr double smallest_detailed =
    10.0;  ///< radius of grains that are drawn with all their corners [pixels]
constexpr double invisible_sagitta = 0.05;  ///< [pixels]
constexpr double rim_share = 0.08;          ///< width of a part's rim, times its radius
constexpr double smallest_rimmed = 5.0;     ///< radius of the parts that get a rim [pixels]
constexpr double thickest_edge = 1.0;       ///< light edge of a chain, on each side [pixels]
constexpr double thinnest_edge = 0.7;       ///< [pixels]
constexpr double wall_width = 4.0;          ///< [pixels]
constexpr double thin_width = 1.5;          ///< edge of a periodic cell or of a window [pixels]
constexpr double thinnest_chain = 0.2;      ///< thinner lines are not drawn [pixels]
constexpr double even_width = 1.5;          ///< [pixels]

/// From metres to pixels.
class Placement {
  public:
    Placement(const Extent& shown, double scale, const Vec2& centre)
        : scale_(scale), centre_(centre), middle_((shown.low + shown.high) / 2.0) {}
    Vec2 operator()(const Vec2& x) const { return centre_ + scale_ * (x - middle_); }
    std::vector<Vec2> operator()(const std::vector<Vec2>& points) const {
        std::vector<Vec2> placed;
        placed.reserve(points.size());
        for (const Vec2& x : points) placed.push_back((*this)(x));
        return placed;
    }

  private:
    double scale_;
    Vec2 centre_, middle_;
};

/// Without the corners of a small polygon that its pixels cannot show.
std::vector<Vec2> without_invisible_corners(std::vector<Vec2> polygon) {
    Vec2 low = polygon[0], high = polygon[0];
    for (const Vec2& corner : polygon) {
        low = low.cwiseMin(corner);
        high = high.cwiseMax(corner);
    }
    const double radius = (high - low).maxCoeff() / 2.0;
    if (radius > smallest_detailed) return polygon;
    const double spacing = 2.0 * std::sqrt(2.0 * invisible_sagitta * radius);
    std::vector<Vec2> kept;
    for (const Vec2& corner : polygon)
        if (kept.empty() || (corner - kept.back()).squaredNorm() >= spacing * spacing) kept.push_back(corner);
    return kept.size() < 3 ? polygon : kept;
}

/// Filled with one colour each, and edged. Below the width that pixels can show, edges get paler.
void draw_outlines(Page& page, const Frame& frame, const PanelScale& scale, const Placement& place,
                   const std::vector<Colour>& colours) {
    const auto outlines = grain_outlines(frame);
    const double width =
        std::min(thickest_outline, outline_share * mean_diameter(frame) * scale.pixels_per_metre);
    Colour edge = outline_colour;
    edge[3] = static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, width)));
    for (std::size_t g = 0; g < outlines.size(); ++g) {
        const auto polygon = without_invisible_corners(place(outlines[g]));
        page.fill(polygon, colours[g]);
        if (width >= thinnest_outline) page.stroke(polygon, std::max(width, 1.0), edge, true);
    }
}

void draw_grains(Page& page, const Frame& frame, const PanelScale& scale, const Placement& place) {
    std::vector<Colour> colours;
    for (const double value : field_values(frame, scale.field))
        colours.push_back(colour_of(scale.colours, value));
    draw_outlines(page, frame, scale, place, colours);
}

/// On the grains' outlines if they were written, so that the pores within a grain differ from those between
/// grains.
void draw_parts(Page& page, const Frame& frame, const PanelScale& scale, const Placement& place) {
    if (frame.grains->GetNumberOfPolys() > 0)
        draw_outlines(
            page, frame, scale, place,
            std::vector<Colour>(static_cast<std::size_t>(frame.grains->GetNumberOfPolys()), inside_grain));
    const auto positions = part_positions(frame);
    const auto radii = part_radii(frame);
    const auto values = field_values(frame, scale.field);
    for (std::size_t p = 0; p < positions.size(); ++p) {
        const Vec2 centre = place(positions[p]);
        const double radius = scale.pixels_per_metre * radii[p];
        const bool rimmed = radius >= smallest_rimmed;
        if (rimmed) page.disc(centre, radius, outline_colour);
        page.disc(centre, rimmed ? radius - std::min(thickest_outline, rim_share * radius) : radius,
                  colour_of(scale.colours, values[p]));
    }
}

/// Placed lines, the strongest last.
std::vector<Chain> make_chains(const Frame& frame, const PanelScale& scale, const Placement& place) {
    std::vector<Chain> chains;
    vtkPolyData* contacts = drawn_contacts(frame);
    const ForceScale& forces = scale.forces(frame);
    if (contacts == nullptr || forces.widest_force <= 0.0) return chains;
    auto lines = cell_points(*contacts, *contacts->GetLines());
    const auto normal_force = cell_scalars(*contacts, "normal_force");
    const auto is_wall = cell_scalars(*contacts, "is_wall");
    const double widest = forces.widest_line * scale.pixels_per_metre;
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (is_wall.at(k) != 0.0) lines[k].resize(2);  // a chain ends at the wall
        const double width = widest * std::min(1.0, normal_force[k] / forces.widest_force);
        if (width >= thinnest_chain) chains.push_back({place(lines[k]), width});
    }
    std::stable_sort(chains.begin(), chains.end(),
                     [](const Chain& a, const Chain& b) { return a.width < b.width; });
    return chains;
}

void draw_box(Page& page, const Frame& frame, const Placement& place) {
    if (!frame.walls) return;
    if (is_periodic(frame)) {
        std::vector<Vec2> corners;
        for (vtkIdType k = 0; k < frame.walls->GetNumberOfPoints(); ++k)
            corners.push_back(place({frame.walls->GetPoint(k)[0], frame.walls->GetPoint(k)[1]}));
        page.stroke(corners, thin_width, black, true);
        return;
    }
    const Extent extent = frame_extent(frame);
    const Vec2 aside = Vec2::Constant(wall_width / 2.0);
    const Vec2 low = place(extent.low) - aside;
    const Vec2 high = place(extent.high) + aside;
    const std::vector<Vec2> corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    page.stroke(corners, wall_width, black, true);
}

}  // namespace

void draw_chains(Page& page, std::span<const Chain> chains, double thinnest_edged) {
    // Below the width that pixels can show evenly, a line gets paler instead of thinner, its edge with it.
    const auto stroke = [&](const Chain& chain, double edge, Colour colour) {
        colour[3] = static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, chain.width / even_width)));
        page.stroke(chain.line, std::max(chain.width, even_width) + 2.0 * edge, colour, false);
    };
    for (const Chain& chain : chains)
        if (chain.width >= thinnest_edged)
            stroke(chain, std::clamp(0.3 * chain.width, thinnest_edge, thickest_edge), white);
    for (const Chain& chain : chains) stroke(chain, 0.0, black);
}

void draw_panel(Page& page, const Frame& frame, const PanelScale& scale, const Vec2& centre) {
    const Extent shown = shown_extent(frame, scale.window);
    const Placement place(shown, scale.pixels_per_metre, centre);
    if (!scale.window.is_whole()) page.clip(place(shown.low), place(shown.high));
    if (frame.parts)
        draw_parts(page, frame, scale, place);
    else
        draw_grains(page, frame, scale, place);
    const bool many = frame.parts || scale.forces(frame).widest_line * scale.pixels_per_metre < even_width;
    draw_chains(page, make_chains(frame, scale, place), many ? even_width : 0.0);
    draw_box(page, frame, place);
    if (scale.window.is_whole()) return;
    page.unclip();
    const Vec2 low = place(shown.low), high = place(shown.high);
    page.stroke(std::vector<Vec2>{low, {high.x(), low.y()}, high, {low.x(), high.y()}}, thin_width, black,
                true);
}

}  // namespace softgrain
