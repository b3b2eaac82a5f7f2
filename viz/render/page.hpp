#pragma once
// A page in pixels, origin lower left: filled polygons in painter's order, text above them.
#include <vtkImageData.h>
#include <vtkSmartPointer.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/vec.hpp"
#include "viz/render/graphics.hpp"

class vtkRenderer;
class vtkTextProperty;

namespace softgrain {

using Colour = std::array<std::uint8_t, 4>;  ///< red, green, blue, opacity
inline constexpr Colour black{0, 0, 0, 255};
inline constexpr Colour white{255, 255, 255, 255};

enum class Align { low, centre, high };  ///< left or bottom, middle, right or top

struct TextStyle {
    double size = 24.0;  ///< font size [pixels]
    Align horizontal = Align::low;
    Align vertical = Align::low;
    bool upright = false;  ///< turned by 90 degrees, read from below
    bool bold = false;
    Colour colour = black;
};

/// The font of every picture: DejaVu Sans if the system has it, else the one built into VTK.
void set_font(vtkTextProperty& property, double size, bool bold);

class Page {
  public:
    Page(int width, int height) : width_(width), height_(height) {}
    int width() const { return width_; }
    int height() const { return height_; }

    /// A simple polygon, convex or not.
    void fill(std::span<const Vec2> polygon, Colour colour);
    /// A line of this width [pixels], its joints round if it is opaque and wide enough for that to show.
    void stroke(std::span<const Vec2> line, double width, Colour colour, bool closed);
    void disc(const Vec2& centre, double radius, Colour colour);
    void rectangle(const Vec2& low, const Vec2& high, Colour colour);
    void text(const Vec2& at, std::string words, const TextStyle& style);

    /// From now on shapes (not texts) are cut off outside this rectangle, until `unclip`.
    void clip(const Vec2& low, const Vec2& high) { clip_ = {{low, high}}; }
    void unclip() { clip_.reset(); }

    /// Adds what is on the page to a scene.
    void add_to(vtkRenderer& renderer) const;
    vtkSmartPointer<vtkImageData> draw(Graphics& graphics) const;

  private:
    struct Text {
        Vec2 at;
        std::string words;
        TextStyle style;
    };
    void triangle(const Vec2& a, const Vec2& b, const Vec2& c, Colour colour);
    void add_triangle(const Vec2& a, const Vec2& b, const Vec2& c, Colour colour);
    void add_shapes(vtkRenderer& renderer) const;
    void add_texts(vtkRenderer& renderer) const;

    int width_, height_;
    std::vector<Vec2> corners_;    ///< three for each triangle
    std::vector<Colour> colours_;  ///< one for each triangle
    std::vector<Text> texts_;
    std::optional<std::array<Vec2, 2>> clip_;  ///< low and high corner
};

/// Draws a renderer's scene on white. Throws OutputError if VTK reports an error.
vtkSmartPointer<vtkImageData> draw_scene(Graphics& graphics, vtkRenderer& renderer, int width, int height);

/// Width of a text [pixels].
double text_width(const std::string& words, double size, bool bold);

/// Throws OutputError.
void write_png(const std::filesystem::path& path, vtkImageData& image);

}  // namespace softgrain
