#pragma once
// One frame drawn on a page: grains or their parts coloured by a field, force chains, walls.
#include <string>
#include <vector>

#include "viz/render/frame_data.hpp"
#include "viz/render/page.hpp"
#include "viz/render/scale.hpp"

namespace softgrain {

/// How strong a line is drawn.
struct ForceScale {
    double widest_force = 0.0;  ///< [N] drawn as the widest line
    double widest_line = 0.0;   ///< [m]
};

/// What all panels of a page have in common, so that they can be compared.
struct PanelScale {
    std::string field;
    ColourRange colours;
    double pixels_per_metre;
    ForceScale grain_forces, part_forces;
    Window window;

    const ForceScale& forces(const Frame& frame) const { return frame.parts ? part_forces : grain_forces; }
};

/// `centre`: where on the page the middle of what is shown goes [pixels].
void draw_panel(Page& page, const Frame& frame, const PanelScale& scale, const Vec2& centre);

/// A line of the force chains, and its width [pixels].
struct Chain {
    std::vector<Vec2> line;
    double width;
};
/// Dark with a light edge, readable on every colour of the scale. Lines narrower than `thinnest_edged`
/// [pixels] go without: among many their edges would hide what is below.
void draw_chains(Page& page, std::span<const Chain> chains, double thinnest_edged = 0.0);

}  // namespace softgrain
