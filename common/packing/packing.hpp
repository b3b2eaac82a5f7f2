#pragma once
// The one initial packing that every method starts from.
#include <vector>

#include "common/box.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// n discs in a box. `frame` turns (or mirrors) the inner structure of a grain, for methods that have one.
struct Packing {
    Box box;
    std::vector<Vec2> center;    ///< [n] [m]
    std::vector<double> radius;  ///< [n] [m], > 0
    std::vector<Mat2> frame;     ///< [n] orthogonal, or empty for identity

    std::size_t size() const { return center.size(); }
    Mat2 frame_of(std::size_t grain) const { return frame.empty() ? Mat2::Identity() : frame[grain]; }
    /// Sum of disc areas / box area.
    double packing_fraction_undeformed() const;
    double mean_radius() const;
    double smallest_radius() const;
};

}  // namespace softgrain
