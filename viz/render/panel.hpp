#pragma once
// One frame drawn on a page: grains coloured by a field, force chains, walls.
#include <string>
#include <vector>

#include "viz/render/page.hpp"
#include "viz/render/run_reader.hpp"
#include "viz/render/scale.hpp"

namespace softgrain {

/// What all panels of a page have in common, so that they can be compared.
struct PanelScale {
    std::string field;
    ColourRange colours;
    double pixels_per_metre;
    double widest_force;  ///< [N] drawn as the widest line
    double widest_line;   ///< [pixels]
};

/// Values of a scalar field of the grains, or magnitudes of a vector field [grains]. Throws InputError with
/// the names there are.
std::vector<double> field_values(const Frame& frame, const std::string& field);
/// Unit of the field, "" if none.
std::string field_unit(const Frame& frame, const std::string& field);
/// Normal force of each contact [contacts] [N].
std::vector<double> contact_forces(const Frame& frame);
/// Mean diameter of discs with the grains' areas [m].
double mean_diameter(const Frame& frame);

struct Extent {
    Vec2 low, high;  ///< [m]
};
/// Of the walls, or of the grains if walls were not written; of both in a periodic cell, whose grains stick
/// out.
Extent frame_extent(const Frame& frame);

/// `centre`: where on the page the middle of the extent goes [pixels].
void draw_panel(Page& page, const Frame& frame, const PanelScale& scale, const Vec2& centre);

/// A line of the force chains, and its width [pixels].
struct Chain {
    std::vector<Vec2> line;
    double width;
};
/// Dark with a light edge, readable on every colour of the scale.
void draw_chains(Page& page, std::span<const Chain> chains);

}  // namespace softgrain
