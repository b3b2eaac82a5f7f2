#pragma once
// What is drawn of a frame: values, forces, sizes, extent.
#include <string>
#include <vector>

#include "common/vec.hpp"
#include "viz/render/run_reader.hpp"

namespace softgrain {

/// One value for each thing that is drawn: for each part if the frame has parts, else for each grain. A
/// scalar field or the magnitudes of a vector field; what parts do not have themselves they take from their
/// grain. Throws InputError with the names there are.
std::vector<double> field_values(const Frame& frame, const std::string& field);
/// Unit of the field, "" if none.
std::string field_unit(const Frame& frame, const std::string& field);

/// [cells] A scalar array of the cells; empty if there is none.
std::vector<double> cell_scalars(vtkPolyData& data, const char* name);
/// The points of each cell [m].
std::vector<std::vector<Vec2>> cell_points(vtkPolyData& data, vtkCellArray& cells);

/// Polygons of the grains; discs of the same area where a run wrote only centroids.
std::vector<std::vector<Vec2>> grain_outlines(const Frame& frame);
/// Mean diameter of discs with the grains' areas [m].
double mean_diameter(const Frame& frame);

/// [parts] Of a frame with parts [m].
std::vector<Vec2> part_positions(const Frame& frame);
std::vector<double> part_radii(const Frame& frame);
double mean_part_diameter(const Frame& frame);

/// The contacts that are drawn: of the parts if the frame has parts. Null if they were not written.
vtkPolyData* drawn_contacts(const Frame& frame);

struct Extent {
    Vec2 low, high;  ///< [m]
    Vec2 size() const { return high - low; }
};
/// Of the walls, or of the grains if walls were not written; of both in a periodic cell, whose grains stick
/// out.
Extent frame_extent(const Frame& frame);

/// The share of a frame's extent that is drawn.
struct Window {
    Vec2 low{0.0, 0.0}, high{1.0, 1.0};
    bool is_whole() const { return low == Vec2{0.0, 0.0} && high == Vec2{1.0, 1.0}; }
};
Extent shown_extent(const Frame& frame, const Window& window);

bool is_periodic(const Frame& frame);

}  // namespace softgrain
