#pragma once
// In which directions grains touch.
#include "common/grain_view.hpp"

namespace softgrain {

/// The share of contacts between grains with their normal near angle t is (1 + anisotropy cos 2(t - angle)) /
/// (2 pi) in its first terms (Rothenburg & Bathurst 1989, Geotechnique 39, 601).
struct Fabric {
    Mat2 tensor = Mat2::Zero();  ///< mean of n (x) n, trace 1; zero without contacts
    double anisotropy = 0.0;     ///< 2 (larger - smaller eigenvalue), 0 to 2
    double angle = 0.0;          ///< of the direction with most contacts, -pi/2 to pi/2 [rad]
};

/// From the mean of n (x) n; anisotropy and angle are 0 for a zero tensor.
Fabric fabric_of(const Mat2& tensor);

/// Of the contacts between grains.
Fabric fabric(const GrainView& view);

}  // namespace softgrain
