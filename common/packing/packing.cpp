#include "common/packing/packing.hpp"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace softgrain {

double Packing::packing_fraction_undeformed() const {
    double area = 0.0;
    for (double r : radius) area += std::numbers::pi * r * r;
    return area / box.area();
}

double Packing::mean_radius() const {
    return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

double Packing::smallest_radius() const {
    return *std::min_element(radius.begin(), radius.end());
}

}  // namespace softgrain
