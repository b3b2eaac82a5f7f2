#pragma once
// A PNG read back, and where a panel of a single picture lies on it.
#include <array>
#include <filesystem>

#include "viz/render/page.hpp"

namespace softgrain {

class Picture {
  public:
    /// Throws std::runtime_error if the file is not a PNG.
    explicit Picture(const std::filesystem::path& path);
    int width() const { return width_; }
    int height() const { return height_; }
    /// Origin lower left.
    std::array<int, 3> pixel(int x, int y) const;
    /// Share of the pixels that lie within `tolerance` of a colour in each component.
    double share_of(Colour colour, int tolerance) const;

  private:
    vtkSmartPointer<vtkImageData> image_;
    int width_ = 0, height_ = 0;
};

bool is_near(const std::array<int, 3>& pixel, Colour colour, int tolerance);

}  // namespace softgrain
