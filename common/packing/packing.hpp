#pragma once
// The one initial packing that every method starts from.
#include <cstdint>
#include <vector>

#include "common/box.hpp"
#include "common/packing/clump_shape.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// Largest aspect ratio of undeformed grains.
inline constexpr double most_elongated = 3.0;

/// n discs, ellipses or clumps of discs in a box. `frame` turns (or mirrors) the inner structure of a grain,
/// for methods that have one.
struct Packing {
    Box box;
    std::vector<Vec2> center;    ///< [n] [m]
    std::vector<double> radius;  ///< [n] [m], > 0; of an ellipse or clump: of the disc of the same area
    std::vector<Mat2> frame;     ///< [n] orthogonal, or empty for identity
    std::vector<std::uint8_t> grain_class = {};  ///< [n] index of the scenario's class, or empty for 0
    std::vector<double> aspect_ratio = {};       ///< [n] a / b >= 1, or empty for discs
    std::vector<double> angle = {};  ///< [n] of the long axis, or of a clump's own x axis, against x [rad];
                                     ///< empty if all are discs
    std::vector<ClumpShape> clumps = {};  ///< [class] of one disc for classes of discs; empty if all are

    std::size_t size() const { return center.size(); }
    std::size_t class_of(std::size_t grain) const { return grain_class.empty() ? 0 : grain_class[grain]; }
    /// Half axes along and across `angle` [m].
    Vec2 half_axes(std::size_t grain) const;
    /// Radius of the disc around the grain [m].
    double reach(std::size_t grain) const;
    /// Of a clump, or the one disc of another grain [m].
    std::vector<Disc> discs_of(std::size_t grain) const;
    /// The undeformed grain is center + shape u, |u| <= 1, symmetric [m].
    Mat2 shape_of(std::size_t grain) const;
    Mat2 frame_of(std::size_t grain) const { return frame.empty() ? Mat2::Identity() : frame[grain]; }
    /// Sum of grain areas / box area.
    double packing_fraction_undeformed() const;
    double mean_radius() const;
    double smallest_radius() const;
};

}  // namespace softgrain
