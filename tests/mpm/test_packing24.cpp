// 24 grains beside the resolved solution.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

Packing packing24() {
    Packing packing;
    packing.box.position = {0.0, 9.7252281033, 0.0, 9.7252281033};
    for (const auto& row :
         test::read_rows(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/packing24_initial_xyr.csv", 3)) {
        packing.center.emplace_back(row[0], row[1]);
        packing.radius.push_back(row[2]);
    }
    return packing;
}

// From its header the reference is good to 1-5 %: a stress within 3 % at equal box size where it
// is smooth, and contacts to within one of 24 grains. 8 points across a radius are enough for that beyond
// phi0 0.86.
TEST(Packing24, StressAndContactsAreTheResolvedOnes) {
    const auto rows = test::read_rows(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/packing24_fem_nu0.3.csv", 7);
    MpmSolver solver(test::scenario_with(0.3, 16), packing24());
    double last = 0.0;
    int compared = 0;
    for (const auto& row : rows) {
        const double L = row[0], phi0 = row[1], phi = row[2], p = row[5], Z = row[6];
        if (phi0 < std::max(0.86, last + 0.03) || phi0 > 0.96) continue;
        last = phi0;
        test::close_in(solver, L, true);
        const GrainView view = solver.view(Need::area | Need::contacts);
        double stress = 0.0, touching = 0.0;
        for (const Vec2& f : view.wall_force) stress += 0.25 * f.norm() / L;
        for (const GrainContact& c : view.contacts) touching += c.with_wall() ? 0.0 : 2.0 / 24.0;
        RecordProperty(fmt::format("phi0_{:.3f}", phi0),
                       fmt::format("stress {:+.4f} Z {:.3f} ({:.3f})", stress / p - 1.0, touching, Z));
        EXPECT_NEAR(stress / p, 1.0, 0.03) << "phi0 " << phi0;
        EXPECT_NEAR(touching, Z, 0.13) << "phi0 " << phi0;
        EXPECT_NEAR(view.covered_area / (L * L), phi, 1e-3);
        ++compared;
    }
    EXPECT_GE(compared, 3);
}

}  // namespace
}  // namespace softgrain::mpm
