#pragma once
// Elementary functions without branches or library calls, so that loops over grains become vector code with
// the same bits on every processor.

#include "common/simd.hpp"

namespace softgrain::sdem {

/// x^(-1/3) for x in [0.04, 8], relative error below 1e-15.
SOFTGRAIN_INLINE double inverse_cube_root(double x) {
    // The tangent of x^(-1/3) at x = 1 in the variable (x-1)/(x+1) is a start from which Newton always rises.
    double y = 1.0 - (2.0 / 3.0) * (x - 1.0) / (x + 1.0);
    for (int k = 0; k < 8; ++k) y = y * (4.0 - x * y * y * y) * (1.0 / 3.0);
    return y;
}

}  // namespace softgrain::sdem
