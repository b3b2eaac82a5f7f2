// The fabric tensor against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/observables/fabric.hpp"

namespace softgrain {
namespace {

GrainContact contact(double angle, int j = 1) {
    const Vec2 normal{std::cos(angle), std::sin(angle)};
    return {0, j, normal, normal, -normal, 0.0};
}

Fabric of(const std::vector<GrainContact>& contacts) {
    const std::vector<Vec2> two(2, Vec2::Zero());
    GrainView view;
    view.centroid = two;
    view.contacts = contacts;
    return fabric(view);
}

TEST(Fabric, OneDirection) {
    const Fabric one = of({contact(0.4), contact(0.4 + std::numbers::pi)});  // the same from either side
    EXPECT_NEAR(one.anisotropy, 2.0, 1e-15);
    EXPECT_NEAR(one.angle, 0.4, 1e-15);
    EXPECT_NEAR(one.tensor.trace(), 1.0, 1e-15);
    EXPECT_NEAR(one.tensor(0, 1), std::cos(0.4) * std::sin(0.4), 1e-15);
    EXPECT_NEAR(of({contact(-1.3)}).angle, -1.3, 1e-15);
}

TEST(Fabric, CrossesAndLatticesAreIsotropic) {
    constexpr double pi = std::numbers::pi;
    EXPECT_NEAR(of({contact(0.3), contact(0.3 + pi / 2.0)}).anisotropy, 0.0, 1e-15);
    EXPECT_NEAR(of({contact(1.0), contact(1.0 + pi / 3.0), contact(1.0 + 2.0 * pi / 3.0)}).anisotropy, 0.0,
                1e-15);
}

TEST(Fabric, IsTheSecondHarmonicOfTheNormals) {
    // Directions at equal steps of the distribution function of (1 + a cos 2(t - t0)) / pi.
    constexpr double a = 0.3, middle = 0.7;
    std::vector<GrainContact> contacts;
    constexpr int n = 2000;
    for (int k = 0; k < n; ++k) {
        const double below = std::numbers::pi * (k + 0.5) / n;
        double t = below;
        for (int i = 0; i < 50; ++i) t = below - 0.5 * a * std::sin(2.0 * t);
        contacts.push_back(contact(t + middle));
    }
    EXPECT_NEAR(of(contacts).anisotropy, a, 1e-6);
    EXPECT_NEAR(of(contacts).angle, middle, 1e-6);
}

TEST(Fabric, WallsDoNotCount) {
    EXPECT_NEAR(of({contact(0.2), contact(1.5, -1)}).angle, 0.2, 1e-15);
    EXPECT_EQ(of({contact(1.5, -1)}).anisotropy, 0.0);
    EXPECT_EQ(of({}).angle, 0.0);
}

}  // namespace
}  // namespace softgrain
