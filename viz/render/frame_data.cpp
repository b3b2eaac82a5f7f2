#include "viz/render/frame_data.hpp"

#include <fmt/format.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>
#include <vtkPointData.h>

#include <cmath>
#include <numbers>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr int disc_corners = 48;

bool can_be_drawn(vtkDataArray* array) {
    return array != nullptr && array->GetNumberOfComponents() <= 3;
}

vtkDataArray* part_array(const Frame& frame, const std::string& name) {
    vtkDataArray* array = frame.parts ? frame.parts->GetPointData()->GetArray(name.c_str()) : nullptr;
    return can_be_drawn(array) ? array : nullptr;
}

vtkDataArray* grain_array(const Frame& frame, const std::string& name) {
    vtkDataArray* array = frame.grains->GetCellData()->GetArray(name.c_str());
    return can_be_drawn(array) ? array : nullptr;
}

void append_names(vtkDataSetAttributes& data, std::vector<std::string>& names) {
    for (int a = 0; a < data.GetNumberOfArrays(); ++a)
        if (can_be_drawn(data.GetArray(a))) names.emplace_back(data.GetArray(a)->GetName());
}

[[noreturn]] void throw_no_field(const Frame& frame, const std::string& field) {
    std::vector<std::string> names;
    append_names(*frame.grains->GetCellData(), names);
    if (frame.parts) append_names(*frame.parts->GetPointData(), names);
    throw InputError(fmt::format("the grains have no scalar or vector field '{}'; there are {}", field,
                                 fmt::join(names, ", ")));
}

/// Values, or magnitudes of vectors.
std::vector<double> sizes(vtkDataArray& array) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(array.GetNumberOfTuples()));
    for (vtkIdType k = 0; k < array.GetNumberOfTuples(); ++k) {
        double square = 0.0;
        for (int c = 0; c < array.GetNumberOfComponents(); ++c)
            square += array.GetComponent(k, c) * array.GetComponent(k, c);
        values.push_back(array.GetNumberOfComponents() == 1 ? array.GetTuple1(k) : std::sqrt(square));
    }
    return values;
}

/// Areas, of the undeformed grains if the current ones were not written.
std::vector<double> grain_areas(const Frame& frame) {
    auto areas = cell_scalars(*frame.grains, "area");
    return areas.empty() ? cell_scalars(*frame.grains, "reference_area") : areas;
}

}  // namespace

std::vector<double> field_values(const Frame& frame, const std::string& field) {
    if (vtkDataArray* of_parts = part_array(frame, field)) return sizes(*of_parts);
    vtkDataArray* array = grain_array(frame, field);
    if (array == nullptr) throw_no_field(frame, field);
    const std::vector<double> of_grains = sizes(*array);
    vtkDataArray* grain = part_array(frame, "grain");
    if (grain == nullptr) return of_grains;
    std::vector<double> values;
    for (vtkIdType k = 0; k < grain->GetNumberOfTuples(); ++k)
        values.push_back(of_grains.at(static_cast<std::size_t>(grain->GetTuple1(k))));
    return values;
}

std::string field_unit(const Frame& frame, const std::string& field) {
    vtkDataArray* array = part_array(frame, field);
    if (array == nullptr) array = grain_array(frame, field);
    if (array == nullptr || !array->HasInformation()) return {};
    const char* unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return unit == nullptr ? std::string() : std::string(unit);
}

std::vector<double> cell_scalars(vtkPolyData& data, const char* name) {
    vtkDataArray* array = data.GetCellData()->GetArray(name);
    return array == nullptr ? std::vector<double>{} : sizes(*array);
}

std::vector<std::vector<Vec2>> cell_points(vtkPolyData& data, vtkCellArray& cells) {
    std::vector<std::vector<Vec2>> all;
    auto it = vtk::TakeSmartPointer(cells.NewIterator());
    for (it->GoToFirstCell(); !it->IsDoneWithTraversal(); it->GoToNextCell()) {
        vtkIdType count = 0;
        const vtkIdType* ids = nullptr;
        it->GetCurrentCell(count, ids);
        auto& points = all.emplace_back();
        for (vtkIdType k = 0; k < count; ++k) {
            double p[3];
            data.GetPoint(ids[k], p);
            points.emplace_back(p[0], p[1]);
        }
    }
    return all;
}

std::vector<std::vector<Vec2>> grain_outlines(const Frame& frame) {
    if (frame.grains->GetNumberOfPolys() > 0) return cell_points(*frame.grains, *frame.grains->GetPolys());
    auto outlines = cell_points(*frame.grains, *frame.grains->GetVerts());
    const auto areas = grain_areas(frame);
    for (std::size_t g = 0; g < outlines.size(); ++g) {
        const Vec2 centre = outlines[g].at(0);
        const double radius = std::sqrt(areas.at(g) / std::numbers::pi);
        outlines[g].clear();
        for (int k = 0; k < disc_corners; ++k) {
            const double angle = 2.0 * std::numbers::pi * k / disc_corners;
            outlines[g].push_back(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
        }
    }
    return outlines;
}

double mean_diameter(const Frame& frame) {
    double sum = 0.0;
    const auto areas = grain_areas(frame);
    for (const double area : areas) sum += 2.0 * std::sqrt(area / std::numbers::pi);
    return areas.empty() ? 0.0 : sum / static_cast<double>(areas.size());
}

std::vector<Vec2> part_positions(const Frame& frame) {
    std::vector<Vec2> positions;
    for (vtkIdType k = 0; k < frame.parts->GetNumberOfPoints(); ++k) {
        double p[3];
        frame.parts->GetPoint(k, p);
        positions.emplace_back(p[0], p[1]);
    }
    return positions;
}

std::vector<double> part_radii(const Frame& frame) {
    vtkDataArray* radius = part_array(frame, "radius");
    if (radius == nullptr) throw OutputError("parts: have no radius; write the frame again");
    return sizes(*radius);
}

double mean_part_diameter(const Frame& frame) {
    double sum = 0.0;
    const auto radii = part_radii(frame);
    for (const double radius : radii) sum += 2.0 * radius;
    return radii.empty() ? 0.0 : sum / static_cast<double>(radii.size());
}

vtkPolyData* drawn_contacts(const Frame& frame) {
    return frame.parts ? frame.part_contacts : frame.contacts;
}

Extent frame_extent(const Frame& frame) {
    double bounds[6];
    (frame.walls ? frame.walls : frame.grains)->GetBounds(bounds);
    Extent extent{{bounds[0], bounds[2]}, {bounds[1], bounds[3]}};
    if (!is_periodic(frame)) return extent;
    frame.grains->GetBounds(bounds);
    extent.low = extent.low.cwiseMin(Vec2{bounds[0], bounds[2]});
    extent.high = extent.high.cwiseMax(Vec2{bounds[1], bounds[3]});
    return extent;
}

Extent shown_extent(const Frame& frame, const Window& window) {
    const Extent all = frame_extent(frame);
    return {all.low + window.low.cwiseProduct(all.size()), all.low + window.high.cwiseProduct(all.size())};
}

bool is_periodic(const Frame& frame) {
    return frame.walls && frame.walls->GetFieldData()->HasArray("periodic") != 0;
}

}  // namespace softgrain
