#pragma once
// Elementary functions without branches or library calls, so that loops over grains become vector code with
// the same bits on every processor.

#include "common/simd.hpp"

namespace softgrain::sdem {

/// exp(-x) for x >= 0, relative error below 2e-14; x beyond 32 counts as 32 (exp(-32) = 1.3e-14).
SOFTGRAIN_INLINE double exp_minus(double x) {
    const double y = -(x < 32.0 ? x : 32.0) * (1.0 / 64.0);  // in [-0.5, 0]
    double e = 1.0 / 6227020800.0;
    e = e * y + 1.0 / 479001600.0;
    e = e * y + 1.0 / 39916800.0;
    e = e * y + 1.0 / 3628800.0;
    e = e * y + 1.0 / 362880.0;
    e = e * y + 1.0 / 40320.0;
    e = e * y + 1.0 / 5040.0;
    e = e * y + 1.0 / 720.0;
    e = e * y + 1.0 / 120.0;
    e = e * y + 1.0 / 24.0;
    e = e * y + 1.0 / 6.0;
    e = e * y + 0.5;
    e = e * y + 1.0;
    e = e * y + 1.0;
    e *= e;
    e *= e;
    e *= e;
    e *= e;
    e *= e;
    return e * e;
}

/// x^(-1/3) for x in [0.04, 8], relative error below 1e-15.
SOFTGRAIN_INLINE double inverse_cube_root(double x) {
    // The tangent of x^(-1/3) at x = 1 in the variable (x-1)/(x+1) is a start from which Newton always rises.
    double y = 1.0 - (2.0 / 3.0) * (x - 1.0) / (x + 1.0);
    for (int k = 0; k < 8; ++k) y = y * (4.0 - x * y * y * y) * (1.0 / 3.0);
    return y;
}

}  // namespace softgrain::sdem
