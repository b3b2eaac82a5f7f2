#pragma once
// How far the motion of a set of points is from an affine one.
#include <span>

#include "common/vec.hpp"

namespace softgrain {

/// The affine map x ~ middle + gradient (X - reference_middle) that fits the motion of points from X to x
/// best (least squares). Falk & Langer, Phys. Rev. E 57 (1998) 7192, Eq. 2.11-2.14; `residual` is their D2min
/// divided by the number of points.
struct AffineFit {
    Vec2 reference_middle = Vec2::Zero();  ///< [m]
    Vec2 middle = Vec2::Zero();            ///< [m]
    Mat2 gradient = Mat2::Identity();      ///< mean deformation gradient
    double residual = 0.0;                 ///< mean of |non_affine|^2 [m^2]

    /// What a point moved beyond the affine map [m].
    Vec2 non_affine(const Vec2& reference, const Vec2& position) const {
        return position - middle - gradient * (reference - reference_middle);
    }
};

/// reference, position [n] [m]. Points on a line, or fewer than three, leave part of the gradient open: it is
/// then as near to the identity as it can be.
AffineFit fit_affine(std::span<const Vec2> reference, std::span<const Vec2> position);

}  // namespace softgrain
