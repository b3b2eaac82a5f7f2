#include <gtest/gtest.h>

#include <cmath>

#include "rigid_dem/contact_law.hpp"

namespace softgrain::rigid_dem {
namespace {

TEST(NormalForce, SpringAndDashpotAddAndNeverPull) {
    const NormalForce pressed = normal_force(0.01, 0.0, 100.0, 0.3, 2.0);
    EXPECT_DOUBLE_EQ(pressed.total, 1.0);
    EXPECT_DOUBLE_EQ(pressed.dashpot, 0.0);
    const NormalForce closing = normal_force(0.01, 0.5, 100.0, 0.3, 4.0);
    EXPECT_DOUBLE_EQ(closing.total, 1.0 + 2.0 * 0.3 * 20.0 * 0.5);
    const NormalForce opening = normal_force(0.01, -10.0, 100.0, 0.3, 4.0);
    EXPECT_DOUBLE_EQ(opening.total, 0.0);
    EXPECT_DOUBLE_EQ(opening.dashpot, -1.0);
}

TEST(ShearForce, SticksBelowTheCoulombLimitAndSlidesAbove) {
    const ShearForce stick = shear_force(0.1, 0.002, 50.0, 1.0);
    EXPECT_DOUBLE_EQ(stick.force, 0.2);
    EXPECT_DOUBLE_EQ(stick.dissipated, 0.0);
    const ShearForce slide = shear_force(0.9, 0.01, 50.0, 1.0);
    EXPECT_DOUBLE_EQ(slide.force, 1.0);
    // work = mean force x increment; stored = (1 - 0.81) / (2 k_t); the rest is dissipated
    EXPECT_NEAR(slide.dissipated, 0.95 * 0.01 - (1.0 - 0.81) / 100.0, 1e-15);
}

}  // namespace
}  // namespace softgrain::rigid_dem
