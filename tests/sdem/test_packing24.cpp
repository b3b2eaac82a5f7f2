// Compaction of 24 grains, nu = 0.3, beside the resolved solution.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness.hpp"

namespace softgrain::sdem {
namespace {

TEST(Packing24, StressAndCoordinationStayAtTheirKnownDistanceFromTheResolvedSolution) {
    std::ifstream file(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/packing24_fem_nu0.3.csv");
    auto solver = test::solver_for(test::scenario_with(0.3), test::packing24());
    double last = 0.0;
    int compared = 0;
    for (std::string line; std::getline(file, line);) {
        double L, phi0, phi, sxx, syy, p, Z;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &L, &phi0, &phi, &sxx, &syy, &p, &Z) !=
            7)
            continue;
        if (phi0 < last + 0.04) continue;
        last = phi0;
        test::close_to(*solver, L, 1e-3);
        test::run(*solver, 1000);
        const GrainView v = solver->view(Need::area | Need::contacts);
        double stress = 0.0, touching = 0.0;
        for (const Vec2& f : v.wall_force) stress += 0.25 * f.norm() / L;
        for (const GrainContact& c : v.contacts) touching += c.with_wall() ? 0.0 : 2.0 / 24.0;
        const double error = stress / p - 1.0, covered = v.covered_area / v.box.area();
        RecordProperty(fmt::format("phi0_{:.3f}", phi0),
                       fmt::format("stress {:+.2f} Z {:.2f} ({:.2f}) phi {:.4f} ({:.4f})", error, touching, Z,
                                   covered, phi));
        if (phi0 < 0.82) continue;  // a few contacts carry all: single grains decide
        ++compared;
        // The printed law is too stiff at small overlaps: +60 % at 0.82, under 10 % from 1.0 on.
        EXPECT_GT(error, -0.05) << "phi0 " << phi0;
        EXPECT_LT(error, phi0 < 1.0 ? 0.7 : 0.12) << "phi0 " << phi0;
        EXPECT_NEAR(touching, Z, 0.35) << "phi0 " << phi0;
        EXPECT_NEAR(covered, phi, 0.02) << "phi0 " << phi0;
    }
    EXPECT_GE(compared, 7);
    EXPECT_FALSE(solver->outside_validity().has_value());
}

}  // namespace
}  // namespace softgrain::sdem
