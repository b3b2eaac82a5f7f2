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

/// A rigid motion: with a constant velocity, or about a fixed point.
struct DrivenMotion {
    Vec2 pivot = Vec2::Zero();     ///< [m]
    double spin = 0.0;             ///< about it [1/s]
    Vec2 velocity = Vec2::Zero();  ///< [m/s]

    /// Of what was at x at time 0.
    Vec2 position(const Vec2& x, double time) const;
    /// Of what is at x now.
    Vec2 velocity_at(const Vec2& x) const { return velocity + spin * perpendicular(x - pivot); }
};

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

    std::vector<DrivenMotion> driven = {};  ///< of the last grains, which no force moves

    std::size_t size() const { return center.size(); }
    /// Grains that forces move; they come first.
    std::size_t free_size() const { return center.size() - driven.size(); }
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
    /// Sum of the areas of the free grains / box area.
    double packing_fraction_undeformed() const;
    double mean_radius() const;
    double smallest_radius() const;
};

}  // namespace softgrain
