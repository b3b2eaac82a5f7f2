#include "viz/render/page.hpp"

#include <fmt/format.h>
#include <vtkActor2D.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkTextRenderer.h>
#include <vtkTypeInt32Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "viz/render/triangulate.hpp"
#include "viz/render/vtk_errors.hpp"

namespace softgrain {
namespace {

constexpr int resolution = 72;       ///< dots per inch: a point of the font is then a pixel
constexpr int samples = 8;           ///< per pixel, as far as the driver has them
constexpr double round_above = 2.5;  ///< line width from which joints are drawn round [pixels]

std::string font_file(bool bold) {
    const std::string folder = "/usr/share/fonts/truetype/dejavu/";
    const std::string file = folder + (bold ? "DejaVuSans-Bold.ttf" : "DejaVuSans.ttf");
    return std::filesystem::exists(file) ? file : std::string();
}

double fraction(Align align) {
    return align == Align::low ? 0.0 : align == Align::centre ? 0.5 : 1.0;
}

/// What of a convex polygon lies in a rectangle (Sutherland and Hodgman 1974).
std::vector<Vec2> clipped(std::vector<Vec2> polygon, const Vec2& low, const Vec2& high) {
    for (int side = 0; side < 4; ++side) {
        const int axis = side / 2;
        const auto inside = [&](const Vec2& p) {
            return side % 2 == 0 ? p[axis] - low[axis] : high[axis] - p[axis];
        };
        std::vector<Vec2> rest;
        for (std::size_t k = 0; k < polygon.size(); ++k) {
            const Vec2& from = polygon[k];
            const Vec2& to = polygon[k + 1 < polygon.size() ? k + 1 : 0];
            const double before = inside(from), after = inside(to);
            if (before >= 0.0) rest.push_back(from);
            if ((before >= 0.0) != (after >= 0.0))
                rest.emplace_back(from + before / (before - after) * (to - from));
        }
        polygon = std::move(rest);
    }
    return polygon;
}

}  // namespace

void set_font(vtkTextProperty& property, double size, bool bold) {
    static const std::array<std::string, 2> files{font_file(false), font_file(true)};
    const std::string& file = files[bold ? 1 : 0];
    if (file.empty()) {
        property.SetFontFamilyToArial();
        property.SetBold(bold ? 1 : 0);
    } else {
        property.SetFontFamily(VTK_FONT_FILE);
        property.SetFontFile(file.c_str());
        property.SetBold(0);
    }
    property.SetItalic(0);
    property.SetShadow(0);
    property.SetColor(0.0, 0.0, 0.0);
    property.SetFontSize(static_cast<int>(std::lround(size)));
}

double text_width(const std::string& words, double size, bool bold) {
    vtkNew<vtkTextProperty> property;
    set_font(*property, size, bold);
    std::array<int, 4> box{};
    vtkTextRenderer::GetInstance()->GetBoundingBox(property, words, box.data(), resolution);
    return box[1] - box[0] + 1;
}

void Page::triangle(const Vec2& a, const Vec2& b, const Vec2& c, Colour colour) {
    if (!clip_) return add_triangle(a, b, c, colour);
    const std::vector<Vec2> rest = clipped({a, b, c}, (*clip_)[0], (*clip_)[1]);
    for (std::size_t k = 2; k < rest.size(); ++k) add_triangle(rest[0], rest[k - 1], rest[k], colour);
}

void Page::add_triangle(const Vec2& a, const Vec2& b, const Vec2& c, Colour colour) {
    corners_.insert(corners_.end(), {a, b, c});
    colours_.push_back(colour);
}

void Page::fill(std::span<const Vec2> polygon, Colour colour) {
    for (const auto& t : triangulate(polygon))
        triangle(polygon[static_cast<std::size_t>(t[0])], polygon[static_cast<std::size_t>(t[1])],
                 polygon[static_cast<std::size_t>(t[2])], colour);
}

void Page::stroke(std::span<const Vec2> line, double width, Colour colour, bool closed) {
    const std::size_t n = line.size();
    for (std::size_t k = 0; k + (closed ? 0 : 1) < n; ++k) {
        const Vec2& a = line[k];
        const Vec2& b = line[(k + 1) % n];
        const double length = (b - a).norm();
        if (length == 0.0) continue;
        const Vec2 side = perpendicular(b - a) * (width / (2.0 * length));
        triangle(a + side, a - side, b - side, colour);
        triangle(a + side, b - side, b + side, colour);
    }
    if (width < round_above || colour[3] != 255) return;
    constexpr int edges = 12;
    const std::size_t ends = closed ? 0 : 1;
    for (std::size_t k = ends; k + ends < n; ++k)
        for (int e = 0; e < edges; ++e) {
            const double from = 2.0 * std::numbers::pi * e / edges;
            const double to = 2.0 * std::numbers::pi * (e + 1) / edges;
            triangle(line[k], line[k] + width / 2.0 * Vec2(std::cos(from), std::sin(from)),
                     line[k] + width / 2.0 * Vec2(std::cos(to), std::sin(to)), colour);
        }
}

void Page::disc(const Vec2& centre, double radius, Colour colour) {
    // Corners for a sagitta of a tenth of a pixel.
    const int corners = std::clamp(static_cast<int>(std::ceil(7.0 * std::sqrt(radius))), 8, 64);
    const auto corner = [&](int k) {
        const double angle = 2.0 * std::numbers::pi * k / corners;
        return Vec2(centre + radius * Vec2(std::cos(angle), std::sin(angle)));
    };
    for (int k = 2; k < corners; ++k) triangle(corner(0), corner(k - 1), corner(k), colour);
}

void Page::rectangle(const Vec2& low, const Vec2& high, Colour colour) {
    const std::array<Vec2, 4> corners{low, Vec2{high.x(), low.y()}, high, Vec2{low.x(), high.y()}};
    fill(corners, colour);
}

void Page::text(const Vec2& at, std::string words, const TextStyle& style) {
    if (!words.empty()) texts_.push_back({at, std::move(words), style});
}

void Page::add_shapes(vtkRenderer& renderer) const {
    const auto count = static_cast<vtkIdType>(corners_.size());
    vtkNew<vtkPoints> points;
    vtkNew<vtkTypeInt32Array> corners_of_triangles;
    vtkNew<vtkUnsignedCharArray> colours;
    points->SetNumberOfPoints(count);
    corners_of_triangles->SetNumberOfValues(count);
    colours->SetNumberOfComponents(4);
    colours->SetNumberOfTuples(count);
    for (vtkIdType k = 0; k < count; ++k) {
        const auto corner = static_cast<std::size_t>(k);
        points->SetPoint(k, corners_[corner].x(), corners_[corner].y(), 0.0);
        corners_of_triangles->SetValue(k, static_cast<int>(k));
        colours->SetTypedTuple(k, colours_[corner / 3].data());
    }
    vtkNew<vtkCellArray> triangles;
    triangles->SetData(3, corners_of_triangles);
    vtkNew<vtkPolyData> shapes;
    shapes->SetPoints(points);
    shapes->SetPolys(triangles);
    shapes->GetPointData()->SetScalars(colours);
    vtkNew<vtkPolyDataMapper2D> mapper;
    mapper->SetInputData(shapes);
    mapper->SetScalarModeToUsePointData();
    mapper->SetColorModeToDirectScalars();
    vtkNew<vtkActor2D> actor;
    actor->SetMapper(mapper);
    renderer.AddActor2D(actor);
}

void Page::add_texts(vtkRenderer& renderer) const {
    for (const Text& text : texts_) {
        vtkNew<vtkTextActor> actor;
        actor->SetInput(text.words.c_str());
        actor->SetTextScaleModeToNone();
        vtkTextProperty& property = *actor->GetTextProperty();
        set_font(property, text.style.size, text.style.bold);
        property.SetColor(text.style.colour[0] / 255.0, text.style.colour[1] / 255.0,
                          text.style.colour[2] / 255.0);
        // Justified by hand: VTK's own justification of turned text moves it.
        std::array<int, 4> box{};
        if (text.style.upright) property.SetOrientation(90.0);
        vtkTextRenderer::GetInstance()->GetBoundingBox(&property, text.words, box.data(), resolution);
        const double along = fraction(text.style.horizontal);
        const double across = fraction(text.style.vertical);
        const double in_x = text.style.upright ? 1.0 - across : along;
        const double in_y = text.style.upright ? along : across;
        actor->SetDisplayPosition(
            static_cast<int>(std::lround(text.at.x() - box[0] - in_x * (box[1] - box[0]))),
            static_cast<int>(std::lround(text.at.y() - box[2] - in_y * (box[3] - box[2]))));
        renderer.AddActor2D(actor);
    }
}

void Page::add_to(vtkRenderer& renderer) const {
    if (!colours_.empty()) add_shapes(renderer);
    add_texts(renderer);
}

vtkSmartPointer<vtkImageData> Page::draw(Graphics& graphics) const {
    vtkNew<vtkRenderer> renderer;
    add_to(*renderer);
    return draw_scene(graphics, *renderer, width_, height_);
}

vtkSmartPointer<vtkImageData> draw_scene(Graphics& graphics, vtkRenderer& renderer, int width, int height) {
    take_vtk_error();
    renderer.SetBackground(1.0, 1.0, 1.0);
    auto window = graphics.make_window(width, height);
    window->SetMultiSamples(samples);
    window->SetDPI(resolution);
    window->AddRenderer(&renderer);
    window->Render();
    vtkNew<vtkWindowToImageFilter> grab;
    grab->SetInput(window);
    grab->ReadFrontBufferOff();
    grab->ShouldRerenderOff();
    grab->SetInputBufferTypeToRGB();
    grab->Update();
    auto image = vtkSmartPointer<vtkImageData>::New();
    image->DeepCopy(grab->GetOutput());
    const std::string error = take_vtk_error();
    if (!error.empty()) throw OutputError("drawing: " + error);
    int extent[3];
    image->GetDimensions(extent);
    if (extent[0] != width || extent[1] != height)
        throw OutputError(fmt::format("drawing: asked for {} x {} pixels, got {} x {}", width, height,
                                      extent[0], extent[1]));
    return image;
}

void write_png(const std::filesystem::path& path, vtkImageData& image) {
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(&image);
    writer->WriteToMemoryOn();
    writer->Write();
    vtkUnsignedCharArray* bytes = writer->GetResult();
    if (bytes == nullptr || bytes->GetNumberOfValues() == 0)
        throw OutputError(path.string() + ": VTK could not encode the picture");
    write_file_atomically(path, {reinterpret_cast<const char*>(bytes->GetPointer(0)),
                                 static_cast<std::size_t>(bytes->GetNumberOfValues())});
}

}  // namespace softgrain
