#pragma once
// Bisection for the largest stable factor on a time step.
#include <functional>

namespace softgrain::bench {

struct FactorSearch {
    double least = 1.0 / 16.0, most = 32.0;  ///< where the search ends
    double resolution = 0.02;                ///< relative
};

/// Largest factor for which `is_stable` is true, to the resolution from below, if it is true below a limit
/// and false above it. `least` if it is true nowhere, `most` if it is true everywhere.
double largest_stable(const std::function<bool(double factor)>& is_stable, const FactorSearch& search = {});

}  // namespace softgrain::bench
