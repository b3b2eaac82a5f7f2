#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bpm/scatter.hpp"

namespace softgrain::bpm {
namespace {

constexpr int count = 20000;

/// Kolmogorov-Smirnov distance of sorted values from the uniform distribution between their ends.
double distance_from_uniform(const std::vector<double>& sorted) {
    double distance = 0.0;
    for (std::size_t n = 0; n < sorted.size(); ++n) {
        const double u = (sorted[n] - sorted.front()) / (sorted.back() - sorted.front());
        distance = std::max(
            distance, std::abs(u - (static_cast<double>(n) + 0.5) / static_cast<double>(sorted.size())));
    }
    return distance;
}

TEST(DiscSizes, FollowTheirLaw) {
    for (const DiscSizes& sizes : std::vector<DiscSizes>{{DiscSizeLaw::uniform_volume, 1.625},
                                                         {DiscSizeLaw::uniform_volume, 20.0},
                                                         {DiscSizeLaw::uniform, 1.625},
                                                         {DiscSizeLaw::uniform, 20.0}}) {
        Random random(4, 2);
        std::vector<double> values = draw_disc_radii(sizes, count, random);
        std::ranges::sort(values);
        EXPECT_LE(values.back() / values.front(), sizes.ratio * (1.0 + 1e-12));
        EXPECT_GE(2.0 * values.front(), sizes.smallest_diameter() * (1.0 - 1e-12));
        EXPECT_LT(2.0 * values.front(), sizes.smallest_diameter() * 1.3);
        double mean = 0.0, mean_square = 0.0;
        for (double r : values) {
            mean += 2.0 * r / count;
            mean_square += 4.0 * r * r / count;
        }
        // 4 standard errors: the deviations are below 0.55 and 1.1.
        EXPECT_NEAR(mean, 1.0, 0.016);
        EXPECT_NEAR(mean_square, sizes.mean_square_diameter(), 0.032);
        if (sizes.law == DiscSizeLaw::uniform_volume)
            for (double& r : values) r *= r;
        EXPECT_LT(distance_from_uniform(values), 1.63 / std::sqrt(count));  // at 1 %
    }
}

TEST(DiscSizes, SingleMeansAllAlike) {
    Random random(1, 1);
    for (double r : draw_disc_radii({DiscSizeLaw::single, 3.0}, 10, random)) EXPECT_EQ(r, 0.5);
    for (double r : draw_disc_radii({DiscSizeLaw::uniform, 1.0}, 10, random)) EXPECT_EQ(r, 0.5);
    for (double r : draw_disc_radii({DiscSizeLaw::uniform_volume, 1.0}, 10, random)) EXPECT_DOUBLE_EQ(r, 0.5);
}

TEST(DiscSizes, TheTimeStepFollowsLightDiscs) {
    EXPECT_DOUBLE_EQ(governing_mass(std::vector<double>{1.0, 1.2, 0.8}), 1.0);
    EXPECT_DOUBLE_EQ(governing_mass(std::vector<double>{1.0, 2.0, 0.1}), 0.2);
}

TEST(DiscSizes, StreamsDiffer) {
    Random a(1, 0), b(1, 1), c(2, 0), again(1, 0);
    const double first = a.uniform();
    EXPECT_NE(first, b.uniform());
    EXPECT_NE(first, c.uniform());
    EXPECT_EQ(first, again.uniform());
}

TEST(Scatter, NoDiscLiesOnAnother) {
    for (const DiscSizes& sizes :
         {DiscSizes{DiscSizeLaw::single, 1.0}, DiscSizes{DiscSizeLaw::uniform, 20.0}}) {
        Random random(3, 0);
        const std::vector<double> radius = draw_disc_radii(sizes, 600, random);
        const std::vector<Vec2> x = scatter_in_circle(radius, 0.4, random);
        double area = 0.0, reach = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            area += radius[i] * radius[i];
            reach = std::max(reach, x[i].norm() + radius[i]);
            for (std::size_t j = i + 1; j < x.size(); ++j)
                ASSERT_GT((x[i] - x[j]).norm(), radius[i] + radius[j]);
        }
        // The circle may have grown by a step or two of 5 %.
        EXPECT_GT(area / (reach * reach), 0.4 / std::pow(1.05, 4.0));
        EXPECT_LT(area / (reach * reach), 0.45);
    }
}

}  // namespace
}  // namespace softgrain::bpm
