#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "common/observables/affine_fit.hpp"

namespace softgrain {
namespace {

std::vector<Vec2> cloud(int n) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    std::vector<Vec2> points;
    for (int k = 0; k < n; ++k) points.emplace_back(100.0 + unit(random), -40.0 + unit(random));
    return points;
}

std::vector<Vec2> moved(const std::vector<Vec2>& points, const Mat2& gradient, const Vec2& shift) {
    std::vector<Vec2> result;
    for (const Vec2& x : points) result.emplace_back(gradient * x + shift);
    return result;
}

TEST(AffineFit, AffineMotionLeavesNothing) {
    const std::vector<Vec2> start = cloud(30);
    Mat2 stretch, turn;
    stretch << 1.3, 0.4, -0.1, 0.7;
    turn << std::cos(2.0), -std::sin(2.0), std::sin(2.0), std::cos(2.0);
    for (const Mat2& gradient : {Mat2(Mat2::Identity()), turn, stretch}) {
        const std::vector<Vec2> end = moved(start, gradient, {3.0, 7.0});
        const AffineFit fit = fit_affine(start, end);
        EXPECT_NEAR((fit.gradient - gradient).norm(), 0.0, 1e-13);
        EXPECT_LT(fit.residual, 1e-24);  // square of the rounding of positions of 100
        EXPECT_LT(fit.non_affine(start[3], end[3]).norm(), 1e-12);
    }
}

/// Corners of a square that move along x by +-a, alternately: orthogonal to every affine motion, so that all
/// of it is left over, whatever affine motion comes on top.
TEST(AffineFit, AnOrthogonalPerturbationIsLeftWhole) {
    const std::vector<Vec2> start{{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    const double a = 0.3;
    Mat2 gradient;
    gradient << 0.9, 0.2, 0.1, 1.2;
    std::vector<Vec2> end = moved(start, gradient, {-2.0, 1.0});
    for (std::size_t k = 0; k < 4; ++k) end[k].x() += k % 2 == 0 ? a : -a;
    const AffineFit fit = fit_affine(start, end);
    EXPECT_NEAR(fit.residual, a * a, 1e-14);
    EXPECT_NEAR((fit.gradient - gradient).norm(), 0.0, 1e-14);
    for (std::size_t k = 0; k < 4; ++k)
        EXPECT_NEAR((fit.non_affine(start[k], end[k]) - Vec2(k % 2 == 0 ? a : -a, 0.0)).norm(), 0.0, 1e-14);
}

/// The fit is the least of all: no other gradient leaves less.
TEST(AffineFit, NoOtherGradientLeavesLess) {
    const std::vector<Vec2> start = cloud(12);
    std::vector<Vec2> end = moved(start, Mat2::Identity(), {0.0, 0.0});
    for (std::size_t k = 0; k < end.size(); ++k)
        end[k] += 0.1 * Vec2(std::sin(7.0 * static_cast<double>(k)), std::cos(3.0 * static_cast<double>(k)));
    AffineFit fit = fit_affine(start, end);
    const auto left = [&](const AffineFit& with) {
        double sum = 0.0;
        for (std::size_t k = 0; k < end.size(); ++k) sum += with.non_affine(start[k], end[k]).squaredNorm();
        return sum / static_cast<double>(end.size());
    };
    EXPECT_NEAR(left(fit), fit.residual, 1e-15);
    for (int entry = 0; entry < 4; ++entry)
        for (const double change : {-1e-3, 1e-3}) {
            AffineFit other = fit;
            other.gradient(entry / 2, entry % 2) += change;
            EXPECT_GT(left(other), fit.residual);
        }
}

TEST(AffineFit, PointsOnALineAndSinglePoints) {
    const std::vector<Vec2> line{{0, 0}, {1, 1}, {2, 2}};
    std::vector<Vec2> end{{5, 0}, {7, 2}, {9, 4}};  // stretched to twice its length along (1, 1)
    const AffineFit fit = fit_affine(line, end);
    EXPECT_NEAR(fit.residual, 0.0, 1e-28);
    EXPECT_NEAR((fit.gradient * Vec2(1, 1) - Vec2(2, 2)).norm(), 0.0, 1e-14);
    EXPECT_NEAR((fit.gradient * Vec2(1, -1) - Vec2(1, -1)).norm(), 0.0, 1e-14) << "open: as it was";
    end[1] += Vec2(-0.3, 0.3);  // a kink: its best fit leaves (-1, 2, -1) / 3 of it
    EXPECT_NEAR(fit_affine(line, end).residual, 0.18 * (1.0 + 4.0 + 1.0) / 9.0 / 3.0, 1e-14);

    const std::vector<Vec2> one{{3, 4}}, there{{5, 6}};
    EXPECT_EQ(fit_affine(one, there).residual, 0.0);
    EXPECT_EQ(fit_affine(one, there).gradient, Mat2(Mat2::Identity()));
    EXPECT_EQ(fit_affine({}, {}).residual, 0.0);
}

}  // namespace
}  // namespace softgrain
