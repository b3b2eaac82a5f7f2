#pragma once
// Real powers of numbers in (0, 1], made of operations that every instruction set does alike. Free of Eigen.
#include <bit>
#include <cstdint>

#include "common/simd.hpp"

namespace softgrain::bpm {

/// Binary logarithm of a normal number > 0; absolute error below 3e-16 + 2e-16 |log2 q|.
SOFTGRAIN_INLINE double binary_logarithm(double q) {
    // q = 2^e m with m in [sqrt(1/2), sqrt(2)).
    constexpr std::uint64_t one = 0x3FF0000000000000U, root_of_half = 0x3FE6A09E667F3BCDU,
                            two_to_52 = 0x4330000000000000U;
    const auto bits = std::bit_cast<std::uint64_t>(q);
    const std::uint64_t biased = (bits + (one - root_of_half)) >> 52U;
    const double e = std::bit_cast<double>(biased | two_to_52) - (0x1p52 + 1023.0);
    const auto m = std::bit_cast<double>(bits - (biased << 52U) + one);
    // log m = 2 artanh(z), |z| < 0.1716.
    const double z = (m - 1.0) / (m + 1.0);
    const double w = z * z;
    double sum = 1.0 / 21.0;
    sum = sum * w + 1.0 / 19.0;
    sum = sum * w + 1.0 / 17.0;
    sum = sum * w + 1.0 / 15.0;
    sum = sum * w + 1.0 / 13.0;
    sum = sum * w + 1.0 / 11.0;
    sum = sum * w + 1.0 / 9.0;
    sum = sum * w + 1.0 / 7.0;
    sum = sum * w + 1.0 / 5.0;
    sum = sum * w + 1.0 / 3.0;
    sum = sum * w + 1.0;
    return e + 2.8853900817779268 * z * sum;  // 2 / ln 2
}

/// 2^y for y <= 1; 2^-1000 below -1000. Relative error below 3e-16.
SOFTGRAIN_INLINE double binary_exponential(double y) {
    constexpr double round = 0x1.8p52;  // adding it leaves the whole part in the last bits
    const double in_range = y > -1000.0 ? y : -1000.0;
    const double shifted = in_range + round;
    const double t = 0.6931471805599453 * (in_range - (shifted - round));  // |t| < 0.347
    double sum = 1.0 / 6227020800.0;
    sum = sum * t + 1.0 / 479001600.0;
    sum = sum * t + 1.0 / 39916800.0;
    sum = sum * t + 1.0 / 3628800.0;
    sum = sum * t + 1.0 / 362880.0;
    sum = sum * t + 1.0 / 40320.0;
    sum = sum * t + 1.0 / 5040.0;
    sum = sum * t + 1.0 / 720.0;
    sum = sum * t + 1.0 / 120.0;
    sum = sum * t + 1.0 / 24.0;
    sum = sum * t + 1.0 / 6.0;
    sum = sum * t + 0.5;
    sum = sum * t + 1.0;
    sum = sum * t + 1.0;
    return std::bit_cast<double>(std::bit_cast<std::uint64_t>(sum) +
                                 (std::bit_cast<std::uint64_t>(shifted) << 52U));
}

/// q^p for 0 < q <= 1 and p >= 0.
SOFTGRAIN_INLINE double power_of(double q, double p) {
    return binary_exponential(p * binary_logarithm(q));
}

}  // namespace softgrain::bpm
