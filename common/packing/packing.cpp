#include "common/packing/packing.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace softgrain {

Vec2 Packing::half_axes(std::size_t grain) const {
    if (aspect_ratio.empty()) return Vec2::Constant(radius[grain]);
    const double root = std::sqrt(aspect_ratio[grain]);
    return {radius[grain] * root, radius[grain] / root};
}

double Packing::reach(std::size_t grain) const {
    const double longest = half_axes(grain).x();
    return clumps.empty() ? longest : std::max(longest, radius[grain] * clumps[class_of(grain)].reach);
}

std::vector<Disc> Packing::discs_of(std::size_t grain) const {
    if (clumps.empty()) return {{center[grain], radius[grain]}};
    std::vector<Disc> discs = clumps[class_of(grain)].discs;
    const Mat2 turn = Eigen::Rotation2Dd(angle[grain]).toRotationMatrix();
    for (Disc& disc : discs)
        disc = {center[grain] + radius[grain] * (turn * disc.center), radius[grain] * disc.radius};
    return discs;
}

Mat2 Packing::shape_of(std::size_t grain) const {
    if (aspect_ratio.empty()) return Mat2::Identity() * radius[grain];
    const double c = std::cos(angle[grain]), s = std::sin(angle[grain]);
    const Mat2 turn = (Mat2() << c, -s, s, c).finished();
    return turn * half_axes(grain).asDiagonal() * turn.transpose();
}

Vec2 DrivenMotion::position(const Vec2& x, double time) const {
    const double c = std::cos(spin * time), s = std::sin(spin * time);
    const Vec2 arm = x - pivot;
    return pivot + Vec2{c * arm.x() - s * arm.y(), s * arm.x() + c * arm.y()} + velocity * time;
}

double Packing::packing_fraction_undeformed() const {
    double area = 0.0;
    for (std::size_t g = 0; g < free_size(); ++g) area += std::numbers::pi * radius[g] * radius[g];
    return area / box.area();
}

double Packing::mean_radius() const {
    return std::accumulate(radius.begin(), radius.end(), 0.0) / static_cast<double>(radius.size());
}

double Packing::smallest_radius() const {
    return *std::min_element(radius.begin(), radius.end());
}

}  // namespace softgrain
