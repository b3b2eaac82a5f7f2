#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdTypeArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "common/errors.hpp"
#include "common/observables/shape.hpp"
#include "viz/writers/places.hpp"
#include "viz/writers/vtp_file.hpp"
#include "viz/writers/writers.hpp"

namespace softgrain {
namespace {

void require_finite(bool finite, std::size_t grain, const char* quantity, double time) {
    if (!finite)
        throw DivergedError(static_cast<int>(grain), quantity, time, "not a number that can be drawn");
}

void add_polygons(const GrainView& view, std::span<const Vec2> shift, vtkPoints& points, vtkPolyData& data) {
    vtkNew<vtkCellArray> polygons;
    for (std::size_t g = 0; g < view.size(); ++g) {
        const auto first = static_cast<std::size_t>(view.outline_offset[g]);
        const auto last = static_cast<std::size_t>(view.outline_offset[g + 1]);
        const std::span<const Vec2> outline = view.outline_point.subspan(first, last - first);
        polygons->InsertNextCell(static_cast<int>(outline.size()));
        for (const Vec2& p : outline) {
            require_finite(p.allFinite(), g, "outline", view.time);
            polygons->InsertCellPoint(
                points.InsertNextPoint(p.x() - shift[g].x(), p.y() - shift[g].y(), 0.0));
        }
    }
    data.SetPolys(polygons);
}

/// What follows from the outlines.
void add_shapes(const GrainView& view, vtkPolyData& data) {
    const std::vector<Shape> shapes = grain_shapes(view);
    const auto add = [&](std::string_view name, std::string_view unit, double Shape::*value) {
        auto array = add_numbers(*data.GetCellData(), name, unit, 1, view.size());
        for (std::size_t g = 0; g < view.size(); ++g)
            array->SetValue(static_cast<vtkIdType>(g), shapes[g].*value);
    };
    add("aspect_ratio", "", &Shape::aspect_ratio);
    add("orientation", "rad", &Shape::orientation);
    add("asphericity", "", &Shape::asphericity);
    add("circularity", "", &Shape::circularity);
}

void add_centroids(const GrainView& view, std::span<const Vec2> shift, vtkPoints& points, vtkPolyData& data) {
    vtkNew<vtkCellArray> vertices;
    for (std::size_t g = 0; g < view.size(); ++g) {
        const Vec2 c = view.centroid[g] - shift[g];
        vertices->InsertNextCell(1);
        vertices->InsertCellPoint(points.InsertNextPoint(c.x(), c.y(), 0.0));
    }
    data.SetVerts(vertices);
}

/// What ParaView needs to draw points as discs (Point Gaussian) or as tensor glyphs: it takes point data
/// only.
void add_point_data(const GrainView& view, std::span<const double> area, vtkPolyData& data) {
    vtkPointData& points = *data.GetPointData();
    auto radius = add_numbers(points, "radius", "m", 1, view.size());
    for (std::size_t g = 0; g < view.size(); ++g)
        radius->SetValue(static_cast<vtkIdType>(g), std::sqrt(area[g] / std::numbers::pi));
    for (const char* name : {"stress", "mean_stress"})
        if (vtkDataArray* array = data.GetCellData()->GetArray(name)) points.AddArray(array);
    points.SetActiveTensors("stress");
    points.SetActiveScalars("mean_stress");
}

void add_scalars(vtkPolyData& data, std::string_view name, std::string_view unit,
                 std::span<const double> values) {
    add_field(*data.GetCellData(), {name, unit, 1, values}, values.size());
}

void add_stress(const GrainView& view, vtkPolyData& data) {
    auto stress = add_numbers(*data.GetCellData(), "stress", "N/m", 9, view.size());
    auto mean = add_numbers(*data.GetCellData(), "mean_stress", "N/m", 1, view.size());
    auto deviatoric = add_numbers(*data.GetCellData(), "deviatoric_stress", "N/m", 1, view.size());
    for (std::size_t g = 0; g < view.size(); ++g) {
        const Mat2& s = view.stress[g];
        require_finite(s.allFinite(), g, "stress", view.time);
        const double shear = (s(0, 1) + s(1, 0)) / 2.0;
        set_tensor(*stress, g, s(0, 0), shear, shear, s(1, 1));
        mean->SetValue(static_cast<vtkIdType>(g), (s(0, 0) + s(1, 1)) / 2.0);
        deviatoric->SetValue(static_cast<vtkIdType>(g), std::hypot((s(0, 0) - s(1, 1)) / 2.0, shear));
    }
    data.GetCellData()->SetActiveTensors("stress");
    data.GetCellData()->SetActiveScalars("mean_stress");  // ParaView colours by it at once
}

void add_identity_and_motion(const GrainView& view, vtkPolyData& data) {
    auto id = add_ids(*data.GetCellData(), "grain", view.size());
    auto velocity = add_numbers(*data.GetCellData(), "velocity", "m/s", 3, view.size());
    for (std::size_t g = 0; g < view.size(); ++g) {
        const Vec2& c = view.centroid[g];
        const Vec2& v = view.velocity[g];
        require_finite(c.allFinite() && v.allFinite(), g, "centroid or velocity", view.time);
        id->SetValue(static_cast<vtkIdType>(g), static_cast<vtkIdType>(g));
        velocity->SetTuple3(static_cast<vtkIdType>(g), v.x(), v.y(), 0.0);
    }
}

}  // namespace

Need grain_data(std::size_t grains, bool outlines) {
    const Need all_but_outlines = Need::area | Need::stress | Need::fields;
    return outlines && grains <= most_outlined_grains ? all_but_outlines | Need::outlines : all_but_outlines;
}

GrainWriter::GrainWriter(std::filesystem::path run_dir, Need needs, std::vector<std::uint8_t> grain_class)
    : frames_(std::move(run_dir), "grains"), needs_(needs), grain_class_(std::move(grain_class)) {}

Need GrainWriter::need(const Sample& sample) const {
    return sample.is_frame ? needs_ : Need::base;
}

std::vector<std::string> GrainWriter::resume(std::span<const double> frame_times) {
    return frames_.resume(frame_times);
}

void GrainWriter::observe(const GrainView& view, const Sample& sample) {
    if (!sample.is_frame) return;
    vtkNew<vtkPolyData> data;
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    add_identity_and_motion(view, *data);
    add_scalars(*data, "mass", "kg", view.mass);
    add_scalars(*data, "reference_area", "m^2", view.reference_area);
    if (wants(needs_, Need::area)) add_scalars(*data, "area", "m^2", view.area);
    const std::vector<Vec2> shift = shift_into_cell(view);
    if (wants(needs_, Need::outlines)) {
        add_polygons(view, shift, *points, *data);
        add_shapes(view, *data);
    } else {
        add_centroids(view, shift, *points, *data);
    }
    if (!grain_class_.empty()) {
        auto grain_class = add_ids(*data->GetCellData(), "grain_class", grain_class_.size());
        for (std::size_t g = 0; g < grain_class_.size(); ++g)
            grain_class->SetValue(static_cast<vtkIdType>(g), grain_class_[g]);
    }
    data->SetPoints(points);
    if (wants(needs_, Need::stress)) add_stress(view, *data);
    if (!wants(needs_, Need::outlines))
        add_point_data(view, wants(needs_, Need::area) ? view.area : view.reference_area, *data);
    if (wants(needs_, Need::fields))
        for (const Field& field : view.fields) add_field(*data->GetCellData(), field, view.size());
    frames_.add(sample.frame, view.time, *data);
}

}  // namespace softgrain
