#include "picture.hpp"

#include <vtkNew.h>
#include <vtkPNGReader.h>

#include <cstdlib>
#include <stdexcept>

namespace softgrain {

Picture::Picture(const std::filesystem::path& path) {
    vtkNew<vtkPNGReader> reader;
    if (!std::filesystem::exists(path) || reader->CanReadFile(path.c_str()) == 0)
        throw std::runtime_error(path.string() + " is not a PNG");
    reader->SetFileName(path.c_str());
    reader->Update();
    image_ = reader->GetOutput();
    width_ = image_->GetDimensions()[0];
    height_ = image_->GetDimensions()[1];
}

std::array<int, 3> Picture::pixel(int x, int y) const {
    std::array<int, 3> colour{};
    for (int c = 0; c < 3; ++c)
        colour[static_cast<std::size_t>(c)] =
            static_cast<int>(image_->GetScalarComponentAsDouble(x, y, 0, c));
    return colour;
}

double Picture::share_of(Colour colour, int tolerance) const {
    long long count = 0;
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) count += is_near(pixel(x, y), colour, tolerance) ? 1 : 0;
    return static_cast<double>(count) / width_ / height_;
}

bool is_near(const std::array<int, 3>& pixel, Colour colour, int tolerance) {
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(pixel[c] - colour[c]) > tolerance) return false;
    return true;
}

}  // namespace softgrain
