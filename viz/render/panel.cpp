#include "viz/render/panel.hpp"

#include <fmt/format.h>
#include <vtkCellArrayIterator.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkInformation.h>
#include <vtkInformationStringKey.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr Colour outline_colour{45, 45, 45, 255};
constexpr double outline_share = 0.025;   ///< width of an outline, times the mean diameter of the grains
constexpr double thickest_outline = 1.4;  ///< [pixels]
constexpr double thickest_edge = 1.0;     ///< light edge of a chain, on each side [pixels]
constexpr double wall_width = 4.0;        ///< [pixels]
constexpr double cell_width = 1.5;        ///< edge of a periodic cell [pixels]
constexpr double thinnest_chain = 0.2;    ///< thinner lines are not drawn [pixels]
constexpr double even_width = 1.5;        ///< [pixels]
constexpr int disc_corners = 48;

bool is_periodic(const Frame& frame) {
    return frame.walls && frame.walls->GetFieldData()->HasArray("periodic") != 0;
}

vtkDataArray* find_array(const Frame& frame, const std::string& name) {
    return frame.grains->GetCellData()->GetArray(name.c_str());
}

std::vector<double> scalar_array(vtkPolyData& data, const char* name) {
    std::vector<double> values;
    vtkDataArray* array = data.GetCellData()->GetArray(name);
    if (array == nullptr) return values;
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k) values.push_back(array->GetTuple1(k));
    return values;
}

/// Areas, of the undeformed grains if the current ones were not written.
std::vector<double> grain_areas(const Frame& frame) {
    auto areas = scalar_array(*frame.grains, "area");
    return areas.empty() ? scalar_array(*frame.grains, "reference_area") : areas;
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

/// Polygons of the grains; discs of the same area where a run wrote only centroids.
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

/// From metres to pixels.
class Placement {
  public:
    Placement(const Frame& frame, double scale, const Vec2& centre) : scale_(scale), centre_(centre) {
        const Extent extent = frame_extent(frame);
        middle_ = (extent.low + extent.high) / 2.0;
    }
    Vec2 operator()(const Vec2& x) const { return centre_ + scale_ * (x - middle_); }
    std::vector<Vec2> operator()(const std::vector<Vec2>& points) const {
        std::vector<Vec2> placed;
        for (const Vec2& x : points) placed.push_back((*this)(x));
        return placed;
    }

  private:
    double scale_;
    Vec2 centre_, middle_;
};

void draw_grains(Page& page, const Frame& frame, const PanelScale& scale, const Placement& place) {
    const auto outlines = grain_outlines(frame);
    const auto values = field_values(frame, scale.field);
    const double outline_width =
        std::min(thickest_outline, outline_share * mean_diameter(frame) * scale.pixels_per_metre);
    for (std::size_t g = 0; g < outlines.size(); ++g) {
        const auto polygon = place(outlines[g]);
        page.fill(polygon, viridis(scale.colours.fraction(values[g])));
        page.stroke(polygon, outline_width, outline_colour, true);
    }
}

/// Placed lines, the strongest last.
std::vector<Chain> make_chains(const Frame& frame, const PanelScale& scale, const Placement& place) {
    std::vector<Chain> chains;
    if (!frame.contacts || scale.widest_force <= 0.0) return chains;
    auto lines = cell_points(*frame.contacts, *frame.contacts->GetLines());
    const auto forces = contact_forces(frame);
    const auto is_wall = scalar_array(*frame.contacts, "is_wall");
    for (std::size_t k = 0; k < lines.size(); ++k) {
        if (is_wall.at(k) != 0.0) lines[k].resize(2);  // a chain ends at the wall
        const double width = scale.widest_line * std::min(1.0, forces[k] / scale.widest_force);
        if (width >= thinnest_chain) chains.push_back({place(lines[k]), width});
    }
    std::stable_sort(chains.begin(), chains.end(),
                     [](const Chain& a, const Chain& b) { return a.width < b.width; });
    return chains;
}

}  // namespace

std::vector<double> field_values(const Frame& frame, const std::string& field) {
    vtkDataArray* array = find_array(frame, field);
    if (array == nullptr || array->GetNumberOfComponents() > 3) {
        std::vector<std::string> names;
        for (int a = 0; a < frame.grains->GetCellData()->GetNumberOfArrays(); ++a) {
            vtkDataArray* other = frame.grains->GetCellData()->GetArray(a);
            if (other != nullptr && other->GetNumberOfComponents() <= 3) names.emplace_back(other->GetName());
        }
        throw InputError(fmt::format("the grains have no scalar or vector field '{}'; there are {}", field,
                                     fmt::join(names, ", ")));
    }
    std::vector<double> values;
    for (vtkIdType k = 0; k < array->GetNumberOfTuples(); ++k) {
        double square = 0.0;
        for (int c = 0; c < array->GetNumberOfComponents(); ++c)
            square += array->GetComponent(k, c) * array->GetComponent(k, c);
        values.push_back(array->GetNumberOfComponents() == 1 ? array->GetTuple1(k) : std::sqrt(square));
    }
    return values;
}

std::string field_unit(const Frame& frame, const std::string& field) {
    vtkDataArray* array = find_array(frame, field);
    if (array == nullptr || !array->HasInformation()) return {};
    const char* unit = array->GetInformation()->Get(vtkDataArray::UNITS_LABEL());
    return unit == nullptr ? std::string() : std::string(unit);
}

std::vector<double> contact_forces(const Frame& frame) {
    return frame.contacts ? scalar_array(*frame.contacts, "normal_force") : std::vector<double>{};
}

double mean_diameter(const Frame& frame) {
    double sum = 0.0;
    const auto areas = grain_areas(frame);
    for (const double area : areas) sum += 2.0 * std::sqrt(area / std::numbers::pi);
    return areas.empty() ? 0.0 : sum / static_cast<double>(areas.size());
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

void draw_chains(Page& page, std::span<const Chain> chains) {
    // Below the width that pixels can show evenly, a line gets paler instead of thinner.
    const auto stroke = [&](const Chain& chain, double extra, Colour colour) {
        colour[3] = static_cast<std::uint8_t>(std::lround(255.0 * std::min(1.0, chain.width / even_width)));
        page.stroke(chain.line, std::max(chain.width, even_width) + extra, colour, false);
    };
    for (const Chain& chain : chains) stroke(chain, 2.0 * std::min(thickest_edge, 0.3 * chain.width), white);
    for (const Chain& chain : chains) stroke(chain, 0.0, black);
}

void draw_panel(Page& page, const Frame& frame, const PanelScale& scale, const Vec2& centre) {
    const Placement place(frame, scale.pixels_per_metre, centre);
    draw_grains(page, frame, scale, place);
    draw_chains(page, make_chains(frame, scale, place));
    if (!frame.walls) return;
    if (is_periodic(frame)) {
        std::vector<Vec2> corners;
        for (vtkIdType k = 0; k < frame.walls->GetNumberOfPoints(); ++k)
            corners.push_back(place({frame.walls->GetPoint(k)[0], frame.walls->GetPoint(k)[1]}));
        page.stroke(corners, cell_width, black, true);
        return;
    }
    const Extent extent = frame_extent(frame);
    const Vec2 aside = Vec2::Constant(wall_width / 2.0);
    const Vec2 low = place(extent.low) - aside;
    const Vec2 high = place(extent.high) + aside;
    const std::vector<Vec2> corners{low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    page.stroke(corners, wall_width, black, true);
}

}  // namespace softgrain
