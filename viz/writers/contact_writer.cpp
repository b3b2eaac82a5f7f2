#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <utility>
#include <vector>

#include "common/errors.hpp"
#include "common/observables/stress.hpp"
#include "viz/writers/places.hpp"
#include "viz/writers/vtp_file.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

void insert_point(vtkPoints& points, vtkCellArray& lines, const Vec2& p) {
    lines.InsertCellPoint(points.InsertNextPoint(p.x(), p.y(), 0.0));
}

/// A line to draw and the contact it belongs to.
struct Polyline {
    std::size_t contact;
    std::vector<Vec2> points;
};

std::vector<Polyline> polylines_of(const GrainView& view) {
    const std::vector<Vec2> shift = shift_into_cell(view);
    std::vector<Polyline> lines;
    for (std::size_t k = 0; k < view.contacts.size(); ++k) {
        const GrainContact& c = view.contacts[k];
        const auto i = static_cast<std::size_t>(c.i);
        const Vec2 from = view.centroid[i] - shift[i];
        const Vec2 point = c.point - shift[i];
        if (c.with_wall()) {
            // The contact point is on the wall but for the depth of contact, which is no length to draw.
            lines.push_back({k, {from, foot_on_wall(view.box, c.wall(), point)}});
            continue;
        }
        const auto j = static_cast<std::size_t>(c.j);
        const Vec2 to = view.centroid[j] - shift[j];
        if (!view.box.periodic) {
            lines.push_back({k, {from, point, to}});
            continue;
        }
        // From the place of j that touches i to the one where it is drawn.
        const Vec2 across = to - (from + branch(view, c));
        if (across.norm() < 1e-9 * view.box.spacing()) {
            lines.push_back({k, {from, point, to}});
        } else {
            lines.push_back({k, {from, point}});
            lines.push_back({k, {to, point + across}});
        }
    }
    return lines;
}

void add_lines(const std::vector<Polyline>& lines, vtkPolyData& data) {
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> cells;
    for (const Polyline& line : lines) {
        cells->InsertNextCell(static_cast<int>(line.points.size()));
        for (const Vec2& p : line.points) insert_point(*points, *cells, p);
    }
    data.SetPoints(points);
    data.SetLines(cells);
}

void add_contact_data(const GrainView& view, const std::vector<Polyline>& lines, vtkPolyData& data) {
    const std::size_t n = lines.size();
    vtkCellData& cells = *data.GetCellData();
    auto normal_force = add_numbers(cells, "normal_force", "N", 1, n);
    auto tangential_force = add_numbers(cells, "tangential_force", "N", 1, n);
    auto force = add_numbers(cells, "force", "N", 3, n);
    auto normal = add_numbers(cells, "normal", "", 3, n);
    auto length = add_numbers(cells, "contact_length", "m", 1, n);
    auto grain_i = add_ids(cells, "grain_i", n);
    auto grain_j = add_ids(cells, "grain_j", n);
    vtkNew<vtkUnsignedCharArray> is_wall;
    is_wall->SetName("is_wall");
    for (std::size_t k = 0; k < n; ++k) {
        const auto cell = static_cast<vtkIdType>(k);
        const GrainContact& contact = view.contacts[lines[k].contact];
        if (!contact.point.allFinite() || !contact.force.allFinite() || !contact.normal.allFinite() ||
            !std::isfinite(contact.length))
            throw DivergedError(contact.i, "contact force or point", view.time,
                                "not a number that can be drawn");
        normal_force->SetValue(cell, contact.normal_force());
        tangential_force->SetValue(cell, contact.force.dot(perpendicular(contact.normal)));
        force->SetTuple3(cell, contact.force.x(), contact.force.y(), 0.0);
        normal->SetTuple3(cell, contact.normal.x(), contact.normal.y(), 0.0);
        length->SetValue(cell, contact.length);
        grain_i->SetValue(cell, contact.i);
        grain_j->SetValue(cell, contact.j);
        is_wall->InsertNextValue(contact.with_wall() ? 1 : 0);
    }
    cells.AddArray(is_wall);
    cells.SetActiveScalars("normal_force");
}

}  // namespace

ContactWriter::ContactWriter(std::filesystem::path run_dir) : frames_(std::move(run_dir), "contacts") {}

Need ContactWriter::need(const Sample& sample) const {
    return sample.is_frame ? Need::contacts : Need::base;
}

std::vector<std::string> ContactWriter::resume(std::span<const double> frame_times) {
    return frames_.resume(frame_times);
}

void ContactWriter::observe(const GrainView& view, const Sample& sample) {
    if (!sample.is_frame) return;
    vtkNew<vtkPolyData> data;
    const std::vector<Polyline> lines = polylines_of(view);
    add_lines(lines, *data);
    add_contact_data(view, lines, *data);
    frames_.add(sample.frame, view.time, *data);
}

}  // namespace softgrain
