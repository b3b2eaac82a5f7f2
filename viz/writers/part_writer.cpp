#include <fmt/format.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>
#include <utility>
#include <vector>

#include "common/at.hpp"
#include "common/errors.hpp"
#include "viz/writers/places.hpp"
#include "viz/writers/vtp_file.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

void require_finite(bool finite, const PartView& parts, std::size_t part, std::string_view quantity,
                    double time) {
    if (!finite)
        throw DivergedError(parts.grain[part], fmt::format("{} of a part", quantity), time,
                            "not a number that can be drawn");
}

/// [p] Where parts are drawn: in a periodic cell with their grain.
std::vector<Vec2> places_of(const GrainView& view) {
    const std::vector<Vec2> shift = shift_into_cell(view);
    std::vector<Vec2> places;
    places.reserve(view.parts.size());
    for (std::size_t p = 0; p < view.parts.size(); ++p) {
        require_finite(view.parts.position[p].allFinite(), view.parts, p, "position", view.time);
        places.emplace_back(view.parts.position[p] - shift[at(view.parts.grain[p])]);
    }
    return places;
}

void add_displacement(const PartView& parts, vtkPointData& data) {
    if (parts.reference.empty()) return;
    auto displacement = add_numbers(data, "displacement", "m", 3, parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
        const Vec2 moved = parts.position[p] - parts.reference[p];
        displacement->SetTuple3(static_cast<vtkIdType>(p), moved.x(), moved.y(), 0.0);
    }
}

void add_parts(const GrainView& view, std::span<const Vec2> places, vtkPolyData& data) {
    const PartView& parts = view.parts;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    vtkNew<vtkCellArray> vertices;
    auto grain = add_ids(*data.GetPointData(), "grain", parts.size());
    for (std::size_t p = 0; p < parts.size(); ++p) {
        vertices->InsertNextCell(1);
        vertices->InsertCellPoint(points->InsertNextPoint(places[p].x(), places[p].y(), 0.0));
        grain->SetValue(static_cast<vtkIdType>(p), parts.grain[p]);
    }
    data.SetPoints(points);
    data.SetVerts(vertices);
    add_field(*data.GetPointData(), {"radius", "m", 1, parts.radius}, parts.size());
    add_displacement(parts, *data.GetPointData());
    for (const Field& field : parts.fields) {
        for (std::size_t k = 0; k < field.values.size(); ++k)
            require_finite(std::isfinite(field.values[k]), parts, k / at(field.components), field.name,
                           view.time);
        add_field(*data.GetPointData(), field, parts.size());
    }
}

/// A line to draw: points by number, and the contact it belongs to.
struct Line {
    vtkIdType from, to;
    std::size_t contact;
};

/// Lines between the places of parts, and to points on walls and within lines that cross a cell, which are
/// added to `points`.
std::vector<Line> lines_of(const GrainView& view, std::span<const Vec2> places, vtkPoints& points) {
    const PartView& parts = view.parts;
    const auto add_point = [&](const Vec2& x) { return points.InsertNextPoint(x.x(), x.y(), 0.0); };
    for (const Vec2& x : places) add_point(x);
    std::vector<Line> lines;
    lines.reserve(parts.contacts.size());
    for (std::size_t k = 0; k < parts.contacts.size(); ++k) {
        const PartContact& c = parts.contacts[k];
        const Vec2& from = places[at(c.i)];
        if (c.with_wall()) {
            lines.push_back({c.i, add_point(foot_on_wall(view.box, c.wall(), from)), k});
            continue;
        }
        const Vec2 straight = places[at(c.j)] - from;
        const Vec2 branch = view.box.periodic ? view.box.nearest(straight) : straight;
        if ((branch - straight).norm() < 1e-9 * view.box.spacing()) {
            lines.push_back({c.i, c.j, k});
        } else {
            lines.push_back({c.i, add_point(from + 0.5 * branch), k});
            lines.push_back({c.j, add_point(places[at(c.j)] - 0.5 * branch), k});
        }
    }
    return lines;
}

void add_contacts(const GrainView& view, const std::vector<Line>& lines, vtkPolyData& data) {
    const PartView& parts = view.parts;
    vtkCellData& cells = *data.GetCellData();
    const std::size_t n = lines.size();
    auto normal_force = add_numbers(cells, "normal_force", "N", 1, n);
    auto tangential_force = add_numbers(cells, "tangential_force", "N", 1, n);
    auto part_i = add_ids(cells, "part_i", n);
    auto part_j = add_ids(cells, "part_j", n);
    auto grain_i = add_ids(cells, "grain_i", n);
    auto grain_j = add_ids(cells, "grain_j", n);
    vtkNew<vtkUnsignedCharArray> is_wall;
    is_wall->SetName("is_wall");
    vtkNew<vtkCellArray> cell_points;
    for (std::size_t k = 0; k < n; ++k) {
        const auto cell = static_cast<vtkIdType>(k);
        const PartContact& contact = parts.contacts[lines[k].contact];
        require_finite(std::isfinite(contact.normal_force) && std::isfinite(contact.tangential_force), parts,
                       at(contact.i), "contact force", view.time);
        cell_points->InsertNextCell({lines[k].from, lines[k].to});
        normal_force->SetValue(cell, contact.normal_force);
        tangential_force->SetValue(cell, contact.tangential_force);
        part_i->SetValue(cell, contact.i);
        part_j->SetValue(cell, contact.j);
        grain_i->SetValue(cell, parts.grain[at(contact.i)]);
        grain_j->SetValue(cell, contact.with_wall() ? contact.j : parts.grain[at(contact.j)]);
        is_wall->InsertNextValue(contact.with_wall() ? 1 : 0);
    }
    data.SetLines(cell_points);
    cells.AddArray(is_wall);
    cells.SetActiveScalars("normal_force");
}

}  // namespace

PartWriter::PartWriter(std::filesystem::path run_dir, bool contacts)
    : run_dir_(std::move(run_dir)),
      contacts_(contacts),
      parts_(run_dir_, "parts"),
      part_contacts_(run_dir_, "part_contacts") {}

Need PartWriter::need(const Sample& sample) const {
    return sample.is_frame ? Need::parts : Need::base;
}

std::vector<std::string> PartWriter::resume(std::span<const double> frame_times) {
    if (!std::filesystem::exists(run_dir_ / "parts.pvd")) return {};  // grains without parts
    std::vector<std::string> lost = parts_.resume(frame_times);
    if (!contacts_) return lost;
    const std::vector<std::string> of_contacts = part_contacts_.resume(frame_times);
    lost.insert(lost.end(), of_contacts.begin(), of_contacts.end());
    return lost;
}

void PartWriter::observe(const GrainView& view, const Sample& sample) {
    if (!sample.is_frame || view.parts.size() == 0) return;
    const std::vector<Vec2> places = places_of(view);
    vtkNew<vtkPolyData> data;
    add_parts(view, places, *data);
    parts_.add(sample.frame, view.time, *data);
    if (!contacts_) return;
    vtkNew<vtkPolyData> contacts;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    const std::vector<Line> lines = lines_of(view, places, *points);
    contacts->SetPoints(points);
    add_contacts(view, lines, *contacts);
    part_contacts_.add(sample.frame, view.time, *contacts);
}

}  // namespace softgrain
