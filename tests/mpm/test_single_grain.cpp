// One grain between walls beside resolved finite elements and the closed form of small contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

struct Curve {
    const char* walls;
    const char* nu;
    double band, small_strain_band;
};

class OneGrain : public testing::TestWithParam<Curve> {};

// The curves are good to 0.1-0.3 %. 32 points across a radius: contacts of strains below 0.03 are two grid
// cells long, and the error goes up and down with where they end in a cell; it falls with the square of the
// spacing.
TEST_P(OneGrain, WallForceIsTheResolvedOne) {
    const Curve curve = GetParam();
    const bool all = std::string_view(curve.walls) == "four";
    const auto rows = test::read_rows(
        fmt::format("{}/sdem/grain_{}wall_nu{}.csv", SOFTGRAIN_TEST_DATA, curve.walls, curve.nu), 2);
    MpmSolver solver(test::scenario_with(std::stod(curve.nu), 32), test::one_grain(all));
    double worst = 0.0, last = 0.0;
    int compared = 0;
    for (const auto& row : rows) {
        const double strain = row[0], force = row[1];
        if (strain < 0.02 - 1e-9 || strain > 0.25 + 1e-9 || strain - last < 0.015) continue;
        last = strain;
        test::close_in(solver, 1.0 - strain, all);
        const double error = solver.wall_force()[3].y() / force - 1.0;
        EXPECT_LT(std::abs(error), strain < 0.03 ? curve.small_strain_band : curve.band)
            << "strain " << strain;
        worst = std::max(worst, std::abs(error));
        ++compared;
    }
    RecordProperty("worst", fmt::format("{:.4f}", worst));
    EXPECT_GE(compared, 8);
}
INSTANTIATE_TEST_SUITE_P(
    Walls, OneGrain,
    testing::Values(Curve{"four", "0", 0.010, 0.015}, Curve{"four", "0.3", 0.010, 0.010},
                    Curve{"four", "0.45", 0.010, 0.010}, Curve{"four", "0.49", 0.010, 0.010},
                    Curve{"two", "0.3", 0.010, 0.010}, Curve{"two", "0.49", 0.010, 0.010}),
    [](const auto& row) {
        return fmt::format("{}_nu{}", row.param.walls, std::lround(100.0 * std::stod(row.param.nu)));
    });

/// e R = F / (pi E*) (2 ln(4R/a) - 1), a^2 = 4 F R / (pi E*) (Johnson 1985, two walls, e = displacement / R),
/// solved for F by bisection.
double johnson(double e, double R, double modulus) {
    double low = 0.0, high = modulus * R;
    for (int k = 0; k < 200; ++k) {
        const double F = 0.5 * (low + high);
        const double a = std::sqrt(4.0 * F * R / (std::numbers::pi * modulus));
        (F / (std::numbers::pi * modulus) * (2.0 * std::log(4.0 * R / a) - 1.0) < e * R ? low : high) = F;
    }
    return 0.5 * (low + high);
}

// Finite elements are 0.6 % from the closed form at a strain of 0.01 (the law is not linear); the rest is the
// grid.
TEST(SmallStrain, IsJohnsonsLineContact) {
    MpmSolver solver(test::scenario_with(0.3, 48), test::one_grain(false));
    test::close_in(solver, 0.99, false);
    const double expected = johnson(0.01, 0.5, 1.0 / (1.0 - 0.09));
    EXPECT_NEAR(solver.wall_force()[3].y() / expected, 1.0, 0.01);
}

/// Johnson's contact is met by every law where strains are small: they have one linear limit.
TEST(SmallStrain, IsTheSameForAllLaws) {
    std::vector<double> force;
    for (const char* law : {"neo_hookean", "saint_venant_kirchhoff", "linear"}) {
        Scenario scenario = test::scenario_with(0.3, 16);
        test::settings(scenario).set("law", std::string(law));
        MpmSolver solver(scenario, test::one_grain(true));
        test::close_in(solver, 0.999, true);
        force.push_back(solver.wall_force()[3].y());
    }
    // Strains below the contact are a few times 0.001.
    EXPECT_NEAR(force[1] / force[0], 1.0, 0.01);
    EXPECT_NEAR(force[2] / force[0], 1.0, 0.01);
}

/// Errors of 4, 8 and 16 cells fall at least with the first order in the mean over the loading (second seen).
TEST(Refinement, ErrorsFallWithTheGrid) {
    const auto rows = test::read_rows(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/grain_fourwall_nu0.3.csv", 2);
    std::vector<double> error;
    for (const int points : {8, 16, 32}) {
        MpmSolver solver(test::scenario_with(0.3, points), test::one_grain(true));
        double sum = 0.0;
        int count = 0;
        for (const auto& row : rows) {
            if (row[0] < 0.05 - 1e-9 || row[0] > 0.25 + 1e-9) continue;
            test::close_in(solver, 1.0 - row[0], true);
            sum += std::pow(solver.wall_force()[3].y() / row[1] - 1.0, 2);
            ++count;
        }
        error.push_back(std::sqrt(sum / count));
    }
    RecordProperty("order", fmt::format("{:.2f} {:.2f}", std::log2(error[0] / error[1]),
                                        std::log2(error[1] / error[2])));
    EXPECT_LT(error[1], 0.5 * error[0]);
    EXPECT_LT(error[2], 0.5 * error[1]);
}

}  // namespace
}  // namespace softgrain::mpm
