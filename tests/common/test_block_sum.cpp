#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>

#include "common/block_sum.hpp"

namespace softgrain {
namespace {

TEST(BlockSum, SquaresClosedForm) {
    // Whole numbers below 2^53: every order of summation is exact. Below, at and above the number of blocks.
    for (const std::size_t n : {0, 1, 2, 31, 32, 33, 1000, 100'003}) {
        const auto square = [](std::size_t k) { return static_cast<double>(k) * static_cast<double>(k); };
        const auto m = static_cast<double>(n);
        const double expected = n == 0 ? 0.0 : (m - 1.0) * m * (2.0 * m - 1.0) / 6.0;
        EXPECT_EQ(block_sum(n, false, square), expected) << n;
        EXPECT_EQ(block_sum(n, true, square), expected) << n;
    }
}

TEST(BlockSum, TheSameBitsForAnyNumberOfThreads) {
    // Terms of both signs over eight decades: the order of summation shows in the bits.
    const auto term = [](std::size_t k) {
        const auto x = static_cast<double>(k);
        return std::sin(12.9898 * x) * std::exp(9.0 * std::sin(0.37 * x));
    };
    const int before = omp_get_max_threads();
    for (const std::size_t n : {7, 40, 20'011}) {
        const double alone = block_sum(n, false, term);
        for (const int threads : {1, 2, 3, 5}) {
            omp_set_num_threads(threads);
            EXPECT_EQ(block_sum(n, true, term), alone) << n << " terms, " << threads << " threads";
        }
    }
    omp_set_num_threads(before);
    double forwards = 0.0;
    for (std::size_t k = 0; k < 20'011; ++k) forwards += term(k);
    EXPECT_NE(block_sum(20'011, true, term), forwards) << "these terms do not tell orders apart";
}

TEST(BlockSum, EveryTermIsAskedForOnce) {
    std::array<int, 45> asked{};
    block_sum(asked.size(), false, [&](std::size_t k) {
        ++asked[k];
        return 0.0;
    });
    for (const int times : asked) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace softgrain
