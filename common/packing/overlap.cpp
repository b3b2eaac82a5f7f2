#include "common/packing/overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace softgrain {

double touching_scale(const Mat2& shape_i, const Mat2& shape_j, const Vec2& branch) {
    const Mat2 a = shape_i * shape_i.transpose(), b = shape_j * shape_j.transpose();
    const auto contact_function = [&](double t) {
        const Mat2 mixed = (1.0 - t) * a + t * b;
        return t * (1.0 - t) * branch.dot(mixed.inverse() * branch);
    };
    // Golden section: concave in t with one maximum between 0 and 1.
    constexpr double golden = 0.6180339887498949;
    constexpr double close_enough = 1e-8;  // the maximum is flat: its value is exact to 1e-15
    double low = 0.0, high = 1.0;
    double left = 1.0 - golden, right = golden;
    double at_left = contact_function(left), at_right = contact_function(right);
    while (high - low > close_enough) {
        if (at_left > at_right) {
            high = right;
            right = left;
            at_right = at_left;
            left = high - golden * (high - low);
            at_left = contact_function(left);
        } else {
            low = left;
            left = right;
            at_left = at_right;
            right = low + golden * (high - low);
            at_right = contact_function(right);
        }
    }
    return std::sqrt(contact_function(0.5 * (low + high)));
}

double relative_overlap(const Packing& packing, std::size_t i, std::size_t j) {
    const Vec2 direct = packing.center[j] - packing.center[i];
    const Vec2 branch = packing.box.periodic ? packing.box.nearest(direct) : direct;
    if (!packing.clumps.empty()) {
        double deepest = -std::numeric_limits<double>::infinity();
        const Vec2 shift = branch - direct;
        for (const Disc& a : packing.discs_of(i))
            for (const Disc& b : packing.discs_of(j)) {
                const double sum = a.radius + b.radius;
                deepest = std::max(deepest, (sum - (b.center + shift - a.center).norm()) / sum);
            }
        return deepest;
    }
    if (!packing.aspect_ratio.empty())
        return 1.0 - touching_scale(packing.shape_of(i), packing.shape_of(j), branch);
    const double sum = packing.radius[i] + packing.radius[j];
    return (sum - branch.norm()) / sum;
}

}  // namespace softgrain
