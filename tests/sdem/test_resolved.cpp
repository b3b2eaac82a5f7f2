// The default law beside resolved solutions: one grain between walls, 24 grains.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness.hpp"

namespace softgrain::sdem {
namespace {

std::unique_ptr<Solver> quasi_static_solver(double nu, const Packing& packing, double tolerance) {
    Scenario s = test::default_scenario(nu);
    test::set_quasi_static(s, tolerance);
    return test::solver_for(s, packing);
}

/// Closes both walls across x, and those across y if `all`, to this width in equilibria not further apart
/// than `step`.
void close_in_equilibrium(Solver& solver, double width, bool all, double step) {
    const Box before = solver.view(Need::base).box;
    const int steps = static_cast<int>(std::ceil((before.width() - width) / step - 1e-9));
    const double speed = 0.5 * (before.width() - width) / steps, across = all ? speed : 0.0;
    for (int k = 0; k < steps; ++k)
        solver.advance(WallMotion{solver.view(Need::base).box, {speed, -speed, across, -across}}, 1.0);
}

struct Curve {
    const char* walls;
    const char* nu;
    double from, to, band;
};

class OneGrain : public testing::TestWithParam<Curve> {};

// Bands: what the law reaches, and half a percent. The resolved curves are good to 0.1-0.2 %.
TEST_P(OneGrain, WallForceIsTheResolvedOne) {
    const Curve curve = GetParam();
    const bool all = std::string_view(curve.walls) == "four";
    std::ifstream in(
        fmt::format("{}/sdem/grain_{}wall_nu{}.csv", SOFTGRAIN_TEST_DATA, curve.walls, curve.nu));
    Packing packing = test::single_grain();
    if (!all) packing.box.position = {0.0, 1.0, -2.0, 3.0};
    const auto solver = quasi_static_solver(std::stod(curve.nu), packing, 1e-5);
    double worst = 0.0;
    int compared = 0;
    for (std::string line; std::getline(in, line);) {
        double strain, force;
        if (std::sscanf(line.c_str(), "%lf,%lf", &strain, &force) != 2 || strain > curve.to + 1e-9) continue;
        close_in_equilibrium(*solver, 1.0 - strain, all, 0.01);
        if (strain < curve.from - 1e-9) continue;
        const double error = solver->wall_force()[1].x() / force - 1.0;
        EXPECT_LT(std::abs(error), curve.band) << "strain " << strain;
        worst = std::max(worst, std::abs(error));
        ++compared;
    }
    RecordProperty("worst", fmt::format("{:.3f}", worst));
    EXPECT_GE(compared, 12);
}
INSTANTIATE_TEST_SUITE_P(
    Walls, OneGrain,
    testing::Values(Curve{"four", "0", 0.01, 0.25, 0.044}, Curve{"four", "0.2", 0.01, 0.25, 0.026},
                    Curve{"four", "0.3", 0.01, 0.25, 0.021}, Curve{"four", "0.4", 0.01, 0.25, 0.018},
                    Curve{"four", "0.45", 0.01, 0.25, 0.024}, Curve{"four", "0.49", 0.01, 0.25, 0.085},
                    Curve{"two", "0", 0.01, 0.3, 0.035}, Curve{"two", "0.2", 0.01, 0.3, 0.030},
                    Curve{"two", "0.3", 0.01, 0.3, 0.024}, Curve{"two", "0.4", 0.01, 0.3, 0.042},
                    Curve{"two", "0.45", 0.01, 0.3, 0.065}, Curve{"two", "0.49", 0.01, 0.3, 0.086}),
    [](const auto& row) {
        return fmt::format("{}_nu{}", row.param.walls, std::lround(100.0 * std::stod(row.param.nu)));
    });

TEST(Packing24, DefaultLawIsNearTheResolvedSolution) {
    std::ifstream file(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/packing24_fem_nu0.3.csv");
    const auto solver = quasi_static_solver(0.3, test::packing24(), 1e-3);
    double last = 0.0;
    int compared = 0;
    for (std::string line; std::getline(file, line);) {
        double L, phi0, phi, sxx, syy, p, Z, Z_w;
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf,%lf", &L, &phi0, &phi, &sxx, &syy, &p, &Z,
                        &Z_w) != 8)
            continue;
        if (phi0 < std::max(0.82, last + 0.04) || phi0 > 1.1) continue;
        last = phi0;
        close_in_equilibrium(*solver, L, true, 0.02);
        const GrainView v = solver->view(Need::area | Need::contacts);
        double stress = 0.0, touching = 0.0;
        for (const Vec2& f : v.wall_force) stress += 0.25 * f.norm() / L;
        for (const GrainContact& c : v.contacts) touching += (c.with_wall() ? 1.0 : 2.0) / 24.0;
        const double error = stress / p - 1.0, covered = v.covered_area / v.box.area();
        RecordProperty(fmt::format("phi0_{:.3f}", phi0),
                       fmt::format("stress {:+.3f} Z_w {:.2f} ({:.2f}) phi {:.4f} ({:.4f})", error, touching,
                                   Z_w, covered, phi));
        ++compared;
        EXPECT_LT(std::abs(error), 0.05) << "phi0 " << phi0;
        EXPECT_NEAR(touching, Z_w, 0.25) << "phi0 " << phi0;
        EXPECT_NEAR(covered, phi, 2e-3) << "phi0 " << phi0;
    }
    EXPECT_GE(compared, 6);
}

}  // namespace
}  // namespace softgrain::sdem
