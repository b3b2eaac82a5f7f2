// Size laws against their distribution functions (Kolmogorov-Smirnov) and moments.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "common/packing/size_laws.hpp"

namespace softgrain {
namespace {

constexpr int draws = 20000;
// Kolmogorov-Smirnov: a right law exceeds 1.95 / sqrt(n) once in a thousand seeds; this seed is fixed.
const double band = 1.95 / std::sqrt(draws);

PackingSpec gaussian(double mean, double deviation, double smallest, double largest) {
    PackingSpec spec;
    spec.radius_mean = mean;
    spec.radius_deviation = deviation;
    spec.radius_min = smallest;
    spec.radius_max = largest;
    return spec;
}

PackingSpec between(SizeLaw law, double smallest, double largest) {
    PackingSpec spec;
    spec.size_law = law;
    spec.radius_min = smallest;
    spec.radius_max = largest;
    return spec;
}

std::vector<double> sorted_radii(PackingSpec spec, std::uint64_t seed = 1) {
    spec.count = draws;
    Random random(seed);
    std::vector<double> radii = draw_radii(spec, random);
    std::sort(radii.begin(), radii.end());
    return radii;
}

/// Largest distance between the empirical and the given distribution function.
double distance(const std::vector<double>& sorted, const std::function<double(double)>& below) {
    double largest = 0.0;
    for (std::size_t k = 0; k < sorted.size(); ++k) {
        const double p = below(sorted[k]);
        largest = std::max({largest, std::abs(p - static_cast<double>(k) / draws),
                            std::abs(p - static_cast<double>(k + 1) / draws)});
    }
    return largest;
}

double normal(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(SizeLaws, GaussianIsTheTruncatedNormal) {
    // Sample A of the SDEM paper, a wide cut, and a cut far narrower than the deviation.
    const std::vector<PackingSpec> specs{
        gaussian(0.012, 0.0024, 0.008, 0.016),
        gaussian(1.0, 0.01, 0.1, 10.0),
        gaussian(1.0, 0.5, 0.99, 1.02),
    };
    for (const PackingSpec& s : specs) {
        const auto z = [&](double r) { return (r - s.radius_mean) / s.radius_deviation; };
        const double low = normal(z(s.radius_min));
        const double high = normal(z(s.radius_max));
        const auto radii = sorted_radii(s);
        EXPECT_GE(radii.front(), s.radius_min);
        EXPECT_LE(radii.back(), s.radius_max);
        EXPECT_LT(distance(radii, [&](double r) { return (normal(z(r)) - low) / (high - low); }), band);
    }
}

TEST(SizeLaws, GaussianWithoutDeviationIsItsMean) {
    const auto radii = sorted_radii(gaussian(0.9, 0.0, 0.5, 1.5));
    EXPECT_EQ(radii.front(), 0.9);
    EXPECT_EQ(radii.back(), 0.9);
}

TEST(SizeLaws, FractalNumberLargerThanR) {
    for (const double dimension : {0.5, 2.0, 3.0}) {
        PackingSpec s = between(SizeLaw::fractal, 0.004, 0.038);
        s.fractal_dimension = dimension;
        const auto power = [&](double r) { return std::pow(r, -dimension); };
        const auto radii = sorted_radii(s);
        EXPECT_GE(radii.front(), s.radius_min * (1.0 - 1e-15));
        EXPECT_LE(radii.back(), s.radius_max);
        const double all = power(s.radius_min) - power(s.radius_max);
        EXPECT_LT(distance(radii, [&](double r) { return (power(s.radius_min) - power(r)) / all; }), band);
    }
}

TEST(SizeLaws, UniformVolumeHasAUniformArea) {
    const PackingSpec s = between(SizeLaw::uniform_volume, 0.7, 1.2);
    const auto radii = sorted_radii(s);
    EXPECT_LT(distance(radii, [](double r) { return (r * r - 0.49) / (1.44 - 0.49); }), band);
    double mean_square = 0.0;
    for (const double r : radii) mean_square += r * r / draws;
    // Standard error of the mean of a uniform variable on [0.49, 1.44]; four of them.
    EXPECT_NEAR(mean_square, 0.5 * (0.49 + 1.44), 4.0 * 0.95 / std::sqrt(12.0 * draws));
}

TEST(SizeLaws, UniformIsUniformInTheRadius) {
    const PackingSpec s = between(SizeLaw::uniform, 0.7, 1.2);
    const auto radii = sorted_radii(s);
    EXPECT_GE(radii.front(), 0.7);
    EXPECT_LE(radii.back(), 1.2);
    EXPECT_LT(distance(radii, [](double r) { return (r - 0.7) / 0.5; }), band);
    EXPECT_GT(distance(radii, [](double r) { return (r * r - 0.49) / (1.44 - 0.49); }), band)
        << "the law of uniform_volume";
}

TEST(SizeLaws, TwoSizesHaveTheirShareByNumber) {
    PackingSpec s = between(SizeLaw::two_sizes, 0.5, 0.7);
    s.small_share = 0.30004;
    const auto radii = sorted_radii(s);
    EXPECT_EQ(std::count(radii.begin(), radii.end(), 0.5), 6001);
    EXPECT_EQ(std::count(radii.begin(), radii.end(), 0.7), draws - 6001);

    // In random order: the small ones among the first half are hypergeometric, 3000 +- 46.
    s.count = draws;
    Random random(1);
    const auto drawn = draw_radii(s, random);
    EXPECT_NEAR(static_cast<double>(std::count(drawn.begin(), drawn.begin() + draws / 2, 0.5)), 3000.0,
                140.0);
}

TEST(SizeLaws, SingleIsTheMean) {
    PackingSpec single = between(SizeLaw::single, 0.1, 0.2);
    single.radius_mean = 0.3;
    const auto radii = sorted_radii(single);
    EXPECT_EQ(radii.front(), 0.3);
    EXPECT_EQ(radii.back(), 0.3);
}

TEST(SizeLaws, TheSeedDecides) {
    EXPECT_EQ(sorted_radii({}, 3), sorted_radii({}, 3));
    EXPECT_NE(sorted_radii({}, 3), sorted_radii({}, 4));
}

TEST(SizeLaws, RandomNumbersAreThoseOfTheStandardsEngine) {
    // The standard fixes the 10000th value of mt19937_64 with its default seed.
    Random random(5489);
    for (int k = 1; k < 10000; ++k) random.unit();
    EXPECT_EQ(random.unit(), static_cast<double>(9981545732273789042ULL >> 11U) / 9007199254740992.0);
}

}  // namespace
}  // namespace softgrain
