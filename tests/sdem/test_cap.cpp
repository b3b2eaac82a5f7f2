// Circular segments against long double.
#include <gtest/gtest.h>

#include <cmath>

#include "sdem/geometry/cap.hpp"

namespace softgrain::sdem {
namespace {

using Real = long double;

/// psi - sin(psi) cos(psi) by its power series in 2 psi where the difference cancels.
Real exact_area(Real psi) {
    const Real x = 2 * psi;
    if (x > 1) return psi - std::sin(x) / 2;
    Real term = x * x * x / 12, sum = 0;
    for (int n = 4; n < 40; n += 2) {
        sum += term;
        term *= -x * x / (Real(n) * Real(n + 1));
    }
    return sum;
}

TEST(UnitCap, AreaAndAngleForEveryOpening) {
    double worst_area = 0.0, worst_angle = 0.0;
    for (int k = 0; k <= 40000; ++k) {
        const double q =
            k <= 20000 ? 1.0 * (k + 1) / 20001 : std::pow(10.0, -9.0 + 12.0 * (k - 20000) / 20000);
        const Real psi = 2 * std::atan(Real(q)), area = exact_area(psi);
        const UnitCap cap = unit_cap(q);
        worst_area = std::max(worst_area, static_cast<double>(std::abs(Real(cap.area) / area - 1)));
        worst_angle = std::max(worst_angle, static_cast<double>(std::abs(Real(cap.half_angle) / psi - 1)));
    }
    RecordProperty("area", testing::PrintToString(worst_area));
    RecordProperty("angle", testing::PrintToString(worst_angle));
    EXPECT_LT(worst_area, 2e-15);
    EXPECT_LT(worst_angle, 1e-15);
}

TEST(UnitCap, IsContinuousAtTheHalfDisc) {
    const UnitCap below = unit_cap(1.0), above = unit_cap(std::nextafter(1.0, 2.0));
    EXPECT_NEAR(below.area, above.area, 2e-15);
    EXPECT_NEAR(below.half_angle, above.half_angle, 2e-15);
}

}  // namespace
}  // namespace softgrain::sdem
