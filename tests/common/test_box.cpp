#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "common/box.hpp"

namespace softgrain {
namespace {

const Box cell{{-1.0, 3.0, 2.0, 5.0}, true, 9.5};  // tilt of more than two widths

/// Shortest of all copies within reach, one by one.
Vec2 shortest(const Box& box, const Vec2& d) {
    Vec2 best = d;
    for (int ix = -12; ix <= 12; ++ix)
        for (int iy = -12; iy <= 12; ++iy)
            if ((d + box.image(ix, iy)).norm() < best.norm()) best = d + box.image(ix, iy);
    return best;
}

TEST(Box, ReducedIsTheSameLatticeWithLittleTilt) {
    const Box reduced = cell.reduced();
    EXPECT_EQ(cell.flips(), 2);
    EXPECT_DOUBLE_EQ(reduced.tilt, 1.5);
    EXPECT_DOUBLE_EQ(cell.flipped(2).tilt, 1.5);
    EXPECT_TRUE(reduced.periodic);
    // (ix, iy) of one is (ix + flips iy, iy) of the other.
    EXPECT_NEAR((cell.image(-1, 2) - reduced.image(-1 + 2 * 2, 2)).norm(), 0.0, 1e-14);
    EXPECT_DOUBLE_EQ(reduced.area(), cell.area());
}

TEST(Box, WrappedPointsLieInTheCell) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const Box& box : {cell, cell.reduced()})
        for (int trial = 0; trial < 200; ++trial) {
            const Vec2 x{20.0 * unit(random), 20.0 * unit(random)};
            const Vec2 inside = box.lattice().inverse() * (box.wrapped(x) - box.origin());
            EXPECT_GE(inside.minCoeff(), -1e-12);
            EXPECT_LE(inside.maxCoeff(), 1.0 + 1e-12);
            const Image image = box.image_of(x);
            EXPECT_NEAR((box.wrapped(x) + box.image(image) - x).norm(), 0.0, 1e-12);
        }
    EXPECT_EQ(cell.image_of(cell.origin() + cell.image(1, 1) + Vec2{0.1, 0.0}), (Image{1, 1}));
}

TEST(Box, NearestIsTheShortestOfAllCopies) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (const Box& box : {cell, cell.reduced()}) {
        int tried = 0;
        for (int trial = 0; trial < 400; ++trial) {
            const Vec2 d{20.0 * unit(random), 9.0 * unit(random)};
            const Vec2 best = shortest(box, d);
            if (best.norm() >= 0.5 * box.reduced().spacing()) continue;  // not promised
            ++tried;
            EXPECT_NEAR((box.nearest(d) - best).norm(), 0.0, 1e-12) << d.transpose();
        }
        EXPECT_GT(tried, 50);
    }
}

TEST(Box, SpacingIsTheDistanceOfOppositeFaces) {
    EXPECT_DOUBLE_EQ((Box{{0.0, 4.0, 0.0, 3.0}, true}).spacing(), 3.0);
    // Faces along (3, 3), 2 apart in x: 2 / sqrt(2).
    EXPECT_DOUBLE_EQ((Box{{0.0, 2.0, 0.0, 3.0}, true, 3.0}).spacing(), std::sqrt(2.0));
}

/// The lattice moves with L: d/dt of every copy's offset is L times the offset, in any basis.
TEST(WallMotion, VelocityGradientCarriesTheLattice) {
    const WallMotion motion{cell, {0.3, -0.5, 0.1, 0.7}, 0.4};
    const Mat2 gradient = motion.velocity_gradient();
    EXPECT_EQ(gradient(1, 0), 0.0);
    for (int ix = -2; ix <= 2; ++ix)
        for (int iy = -2; iy <= 2; ++iy) {
            EXPECT_NEAR((gradient * cell.image(ix, iy) - motion.image_velocity(ix, iy)).norm(), 0.0, 1e-13);
            const Vec2 moved = motion.after(0.5).image(ix, iy) - cell.image(ix, iy);
            EXPECT_NEAR((moved - 0.5 * motion.image_velocity(ix, iy)).norm(), 0.0, 1e-13);
        }
    const WallMotion other = motion.flipped(2);
    EXPECT_NEAR((other.velocity_gradient() - gradient).norm(), 0.0, 1e-14);
    EXPECT_NEAR((other.after(0.5).lattice() - motion.after(0.5).flipped(2).lattice()).norm(), 0.0, 1e-14);
    // The flow moves the origin with its walls, and a point an image away by the image's velocity more.
    EXPECT_NEAR((motion.affine_velocity(cell.origin()) - Vec2(0.3, 0.1)).norm(), 0.0, 1e-15);
    const Vec2 x{0.4, 3.0};
    EXPECT_NEAR((motion.affine_velocity(x + cell.image(1, -1)) - motion.affine_velocity(x) -
                 motion.image_velocity(1, -1))
                    .norm(),
                0.0, 1e-13);
}

}  // namespace
}  // namespace softgrain
