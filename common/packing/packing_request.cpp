#include "common/packing/packing_request.hpp"

#include <cmath>
#include <numbers>

namespace softgrain {

Box PackingRequest::box_for(const std::vector<double>& radii, double disc_fraction) const {
    const double width = std::sqrt(disc_area(radii) / (disc_fraction * aspect_ratio));
    return {{0.0, width, 0.0, aspect_ratio * width}, periodic};
}

double disc_area(const std::vector<double>& radii) {
    double area = 0.0;
    for (const double r : radii) area += std::numbers::pi * r * r;
    return area;
}

}  // namespace softgrain
