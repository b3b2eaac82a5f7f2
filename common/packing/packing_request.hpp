#pragma once
// What a generator is to make, beside the radii.
#include <optional>
#include <vector>

#include "common/box.hpp"

namespace softgrain {

struct PackingRequest {
    double aspect_ratio = 1.0;  ///< height / width
    /// Stop at this packing fraction of the grains, below jamming.
    std::optional<double> packing_fraction = {};
    bool periodic = false;
    double grain_share =
        1.0;  ///< area of the grains / area of the discs, less than 1 for grains inside discs

    /// The packing fraction of the discs that is asked for, or `otherwise`.
    double disc_fraction_or(double otherwise) const {
        return packing_fraction ? *packing_fraction / grain_share : otherwise;
    }
    /// [0, width] x [0, height], filled by the discs to `disc_fraction` [m].
    Box box_for(const std::vector<double>& radii, double disc_fraction) const;
};

/// Sum of pi r^2 [m^2].
double disc_area(const std::vector<double>& radii);

}  // namespace softgrain
