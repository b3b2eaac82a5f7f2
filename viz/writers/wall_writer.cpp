#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <utility>

#include "common/errors.hpp"
#include "viz/writers/vtp_file.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

/// Corners counter-clockwise from the lower left, and the two that end each wall (left, right, bottom, top).
constexpr int wall_corner[4][2] = {{3, 0}, {1, 2}, {0, 1}, {2, 3}};

vtkSmartPointer<vtkPolyData> wall_lines(const Box& given) {
    const Box box = given.reduced();
    const auto& p = box.position;
    auto data = vtkSmartPointer<vtkPolyData>::New();
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->InsertNextPoint(p[0], p[2], 0.0);
    points->InsertNextPoint(p[1], p[2], 0.0);
    points->InsertNextPoint(p[1] + box.tilt, p[3], 0.0);
    points->InsertNextPoint(p[0] + box.tilt, p[3], 0.0);
    vtkNew<vtkCellArray> lines;
    for (const auto& corners : wall_corner) {
        lines->InsertNextCell(2);
        lines->InsertCellPoint(corners[0]);
        lines->InsertCellPoint(corners[1]);
    }
    data->SetPoints(points);
    data->SetLines(lines);
    return data;
}

}  // namespace

WallWriter::WallWriter(std::filesystem::path run_dir) : frames_(std::move(run_dir), "walls") {}

Need WallWriter::need(const Sample&) const {
    return Need::base;
}

std::vector<std::string> WallWriter::resume(std::span<const double> frame_times) {
    return frames_.resume(frame_times);
}

void WallWriter::observe(const GrainView& view, const Sample& sample) {
    if (!sample.is_frame) return;
    auto data = wall_lines(view.box);
    vtkCellData& cells = *data->GetCellData();
    auto id = add_ids(cells, "wall", 4);
    auto force = add_numbers(cells, "wall_force", "N", 3, 4);
    auto normal_force = add_numbers(cells, "normal_force", "N", 1, 4);
    auto stress = add_numbers(cells, "wall_stress", "N/m", 1, 4);
    for (int wall = 0; wall < 4; ++wall) {
        const auto w = static_cast<std::size_t>(wall);
        const Vec2& on_wall = view.wall_force[w];
        if (!on_wall.allFinite() || !std::isfinite(view.box.position[w]) || !std::isfinite(view.box.tilt))
            throw DivergedError(-1, "force or position of the wall " + std::string(wall_names[w]), view.time,
                                "not a number that can be drawn");
        const double length = wall_axis(wall) == 0 ? view.box.height() : view.box.width();
        const double outward = -on_wall.dot(wall_normal(wall));
        id->SetValue(wall, wall);
        force->SetTuple3(wall, on_wall.x(), on_wall.y(), 0.0);
        normal_force->SetValue(wall, outward);
        stress->SetValue(wall, outward / length);
    }
    if (view.box.periodic) {
        vtkNew<vtkIntArray> periodic;
        periodic->SetName("periodic");
        periodic->InsertNextValue(1);
        data->GetFieldData()->AddArray(periodic);
    }
    frames_.add(sample.frame, view.time, *data);
}

}  // namespace softgrain
