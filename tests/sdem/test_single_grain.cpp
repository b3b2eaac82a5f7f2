// One grain: the stress law, free oscillations, four walls against the resolved reference.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numbers>

#include "probe.hpp"
#include "random_ellipses.hpp"
#include "sdem/contact.hpp"
#include "sdem/grains.hpp"
#include "sdem/kinematics.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {
namespace {

TEST(Mollon2022, PiolaIsThePaperInThePrincipalFrame) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> strain(-0.5, 0.5), angle(0.0, 6.28);
    const double E = 3.0, nu = 0.3;
    const double mu = E / (2.0 * (1.0 + nu)), kappa = E / (3.0 - 6.0 * nu);  // Eq. 45, 46
    const double lambda = E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu));          // Eq. 44
    for (int k = 0; k < 100; ++k) {
        // F = R N diag(1 + e) N^T with a known rotation R and principal frame N.
        const double e1 = strain(random), e2 = strain(random), eps_v = 0.1 * std::sin(k);
        const Mat2 R = test::rotation(angle(random)), N = test::rotation(angle(random));
        const Mat2 F = R * N * Vec2{1.0 + e1, 1.0 + e2}.asDiagonal() * N.transpose();
        const double dev1 = e1 - 0.5 * (e1 + e2), dev2 = e2 - 0.5 * (e1 + e2);         // Eq. 39, 40
        const double s1 = (2.0 * mu + lambda) * dev1 + lambda * dev2 + kappa * eps_v;  // Eq. 42
        const double s2 = lambda * dev1 + (2.0 * mu + lambda) * dev2 + kappa * eps_v;  // Eq. 43
        const Mat2 expected = R * N * Vec2{s1, s2}.asDiagonal() * N.transpose();
        const Mat2 ours = matrix_of(linear_piola(tensor_of(F), mu, kappa, eps_v));
        EXPECT_NEAR((ours - expected).norm(), 0.0, 1e-13 * E);
    }
}

TEST(Mollon2022, NormalForceIsEquation56And61) {
    const double E = 2.0, gamma = 0.7, L = 0.3, delta = -0.02, mass = 4.0;
    const double strain = delta / ((0.58 * L + 2.0 * delta) - delta);  // Eq. 55
    ContactInput contact{L, -delta, 0.0, E, mass};
    const ContactAnswer still = Mollon2022::contact(contact, gamma);
    EXPECT_NEAR(still.q * L, -E * strain * L, 1e-15);
    EXPECT_NEAR(still.q * L, still.stiffness * -delta, 1e-15);
    EXPECT_EQ(still.q_damping, 0.0);
    contact.rate = 0.01;
    const ContactAnswer closing = Mollon2022::contact(contact, gamma);
    EXPECT_NEAR(closing.q_damping * L, gamma * std::sqrt(closing.stiffness * mass) * 0.01, 1e-15);
    contact.rate = -10.0;
    const ContactAnswer opening = Mollon2022::contact(contact, gamma);
    EXPECT_LT(opening.q_damping, -opening.q);
    EXPECT_EQ(opening.q + damping_without_pull(opening.q, opening.q_damping), 0.0);
}

/// Angular frequency of F(0,0) - 1.
double frequency(double nu, const Mat2& start, double radius, double density) {
    Scenario s = test::scenario_with(nu);
    test::switch_off_damping(s);
    s.material.density = density;
    auto solver = test::solver_for(s, test::packing_of(test::far_away(), {Vec2::Zero()}, {radius}));
    test::State state = test::state_of(*solver);
    state.F[0] = start;
    test::set_state(*solver, state);
    return test::free_frequency(*solver, 0.02 * solver->stable_time_step(), 6000);
}

TEST(FreeGrain, OscillatesAtTheClosedFormFrequencies) {
    const double R = 0.3, rho = 2.0, e = 1e-5;
    for (double nu : {0.0, 0.3}) {
        const double mu = 1.0 / (2.0 * (1.0 + nu)), kappa = 1.0 / (3.0 - 6.0 * nu);
        const Mat2 shape = Vec2{1.0 + e, 1.0 - e}.asDiagonal().toDenseMatrix();
        const Mat2 volume = (1.0 + e) * Mat2::Identity();
        // The time step shifts frequencies by (omega dt)^2 / 24 < 1e-4.
        EXPECT_NEAR(frequency(nu, shape, R, rho) / std::sqrt(8.0 * mu / (rho * R * R)), 1.0, 2e-4);
        EXPECT_NEAR(frequency(nu, volume, R, rho) / std::sqrt(8.0 * kappa / (rho * R * R)), 1.0, 2e-4);
    }
    // Incompressible: the shape mode alone.
    const double mu = 1.0 / 3.0;
    const Mat2 shape = Vec2{1.0 + e, 1.0 - e}.asDiagonal().toDenseMatrix();
    EXPECT_NEAR(frequency(0.5, shape, R, rho) / std::sqrt(8.0 * mu / (rho * R * R)), 1.0, 2e-4);
}

TEST(FreeGrain, ElasticEnergyOfTheShapeModeIsItsPotential) {
    Scenario s = test::scenario_with(0.3);
    test::switch_off_damping(s);
    auto solver = test::solver_for(s, test::packing_of(test::far_away(), {Vec2::Zero()}, {1.0}));
    test::State state = test::state_of(*solver);
    state.F_rate[0] << 0.01, 0.005, 0.005, -0.01;
    test::set_state(*solver, state);
    const double initial = solver->view(Need::base).energy.kinetic;
    EXPECT_NEAR(initial, 0.5 * std::numbers::pi / 4.0 * 0.00025, 1e-15);
    const double mu = 1.0 / 2.6;
    for (int k = 0; k < 300; ++k) {
        solver->advance(WallMotion{test::far_away(), {}}, 0.05 * solver->stable_time_step());
        const EnergyLedger e = solver->view(Need::base).energy;
        const Tensor F = tensor_of(test::state_of(*solver).F[0]);
        const double d = half_stretch_difference(F);
        // A0 P does 2 mu d on each of the two axes; eps_V = -d^2 adds a part of order d.
        const double potential = std::numbers::pi * (2.0 * mu * d * d);
        EXPECT_NEAR(e.elastic, potential, 2e-3 * initial);
        EXPECT_NEAR(test::residual(e, initial), 0.0, 1e-14);
    }
}

TEST(FreeGrain, ShapeDampingSparesTheSpin) {
    Scenario s = test::scenario_with(0.3);
    auto solver = test::solver_for(s, test::packing_of(test::far_away(), {Vec2::Zero()}, {1.0}));
    test::State state = test::state_of(*solver);
    state.F_rate[0] << 0.05, -0.02, 0.02, -0.05;
    test::set_state(*solver, state);
    const auto spin = [&] {
        const test::State now = test::state_of(*solver);
        return cross(now.F[0].col(0), now.F_rate[0].col(0)) + cross(now.F[0].col(1), now.F_rate[0].col(1));
    };
    const double before = spin();
    test::run(*solver, 400);
    EXPECT_NEAR(spin(), before, 1e-13);
    const test::State now = test::state_of(*solver);
    // F' is kept half a step behind F, which shows as spin^2 dt / 2 |F|.
    const double half_step_lag = 0.02 * 0.02 * solver->stable_time_step();
    const Tensor left = without_spin(tensor_of(now.F[0]), tensor_of(now.F_rate[0]), Inertia{1.0, 1.0});
    EXPECT_LT(std::sqrt(left.squared()), half_step_lag);
}

/// Wall force at each wall displacement / radius of the resolved solution, and ours.
struct Point {
    double strain, resolved, ours;
};
std::vector<Point> four_walls(const std::string& file, double nu, double largest) {
    std::ifstream in(std::string(SOFTGRAIN_TEST_DATA) + "/sdem/" + file);
    auto solver = test::solver_for(test::scenario_with(nu), test::single_grain());
    std::vector<Point> points;
    for (std::string line; std::getline(in, line);) {
        double strain, force;
        if (std::sscanf(line.c_str(), "%lf,%lf", &strain, &force) != 2 || strain > largest + 1e-9) continue;
        test::close_to(*solver, 1.0 - strain, 5e-4);
        test::run(*solver, 200);
        points.push_back({strain, force, solver->wall_force()[1].x()});
    }
    return points;
}

/// Static solution for one grain between four walls, F = J I: the root of the isotropic balance in one
/// unknown.
double static_wall_force(double nu, double strain) {
    const double R = 0.5, kappa = 1.0 / (3.0 - 6.0 * nu), area = std::numbers::pi * R * R;
    const double distance = R * (1.0 - strain);
    const auto force_and_balance = [&](double stretch) {
        const double r = R * stretch, depth = r - distance;
        const double half = std::sqrt(r * r - distance * distance), psi = std::acos(distance / r);
        const double cap = r * r * (psi - std::sin(psi) * std::cos(psi)), L = 2.0 * half;
        const double force = L * depth / (0.58 * L - depth);
        const double eps_v = (std::numbers::pi * r * r - 4.0 * cap) / area - 1.0;
        // sum f (x) X = A0 P on the diagonal: two walls each push with arm distance / stretch.
        return std::pair{force, -2.0 * force * distance / stretch - area * kappa * eps_v};
    };
    // The root next to the free disc; the printed law can have a second, unstable one, or none.
    double low = (1.0 - strain) * (1.0 + 1e-12), high = low;
    while (force_and_balance(high).second > 0.0 && high < 1.3) high += 1e-3;
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        (force_and_balance(middle).second > 0.0 ? low : high) = middle;
    }
    const bool caps_apart = R * low < std::numbers::sqrt2 * distance;
    return caps_apart ? force_and_balance(low).first : std::nan("");
}

class FourWalls : public testing::TestWithParam<std::pair<const char*, double>> {};

// The law as printed is known to be too stiff at small strain (PHYSICS 1.3); what is checked is that the
// solver gives the law's own static solution, and that its distance from the resolved one is the known one.
TEST_P(FourWalls, GivesTheLawsStaticForce) {
    const auto [file, nu] = GetParam();
    const std::vector<Point> points = four_walls(file, nu, 0.25);
    ASSERT_GE(points.size(), 20U);
    int compared = 0;
    for (const Point& p : points) {
        // Where the caps meet in the corners the printed law has no answer; ours stays between bounds.
        const double expected = static_wall_force(nu, p.strain);
        if (std::isfinite(expected)) {
            EXPECT_NEAR(p.ours / expected, 1.0, 1e-3) << "strain " << p.strain;
            ++compared;
        }
        const double error = p.ours / p.resolved - 1.0;
        if (std::abs(p.strain - 0.02) < 1e-6) {
            EXPECT_GT(error, 0.2);
            EXPECT_LT(error, 1.0);
        }
        if (p.strain > 0.0999 && p.strain < 0.2001) {
            EXPECT_LT(std::abs(error), 0.45);
        }
        EXPECT_LT(std::abs(error), 1.2);
        RecordProperty(fmt::format("error_{:.2f}", p.strain), fmt::format("{:+.3f}", error));
    }
    EXPECT_GE(compared, 15);
}
INSTANTIATE_TEST_SUITE_P(Poisson, FourWalls,
                         testing::Values(std::pair{"grain_fourwall_nu0.csv", 0.0},
                                         std::pair{"grain_fourwall_nu0.3.csv", 0.3},
                                         std::pair{"grain_fourwall_nu0.45.csv", 0.45}));

TEST(Incompressible, OneGrainKeepsItsAreaUntilTheBoxIsFull) {
    auto solver = test::solver_for(test::scenario_with(0.5), test::single_grain());
    const double area = std::numbers::pi * 0.25;
    // packing_fraction_undeformed = area / width^2
    for (double fraction : {0.85, 0.95, 0.99, 0.999}) {
        test::close_to(*solver, std::sqrt(area / fraction), 2e-4);
        test::run(*solver, 400);
        EXPECT_NEAR(solver->view(Need::area).area[0], area, 1e-6 * area) << "fraction " << fraction;
    }
    // Past 1 the area cannot be kept: no jump, nothing infinite.
    test::close_to(*solver, std::sqrt(area / 1.02), 2e-4);
    test::run(*solver, 400);
    solver->check_finite();
    EXPECT_LT(test::state_of(*solver).F[0].determinant(), 2.2);
}

}  // namespace
}  // namespace softgrain::sdem
