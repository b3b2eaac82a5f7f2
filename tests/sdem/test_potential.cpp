// The lens potential: forces are its derivatives, whatever the grains are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"
#include "sdem/laws/lens_potential.hpp"

namespace softgrain::sdem {
namespace {

struct Case {
    const char* name;
    const char* grain_law;
    double nu, second_nu, cohesion;
};

class Gradient : public testing::TestWithParam<Case> {
  protected:
    Scenario scenario() const {
        Scenario s = test::default_scenario(GetParam().nu);
        test::switch_off_damping(s);
        test::settings(s).set("grain_law", std::string(GetParam().grain_law));
        test::settings(s).set("dilation_inertia", 0.0);
        s.material.cohesion = GetParam().cohesion;
        test::add_classes(s, 3.0, GetParam().second_nu);
        return s;
    }
    static constexpr double step = 5e-5;
    // Rounding of the energy / step is 1e-11, truncation step^4 / depth^3 below 1e-8 where contacts are
    // shallow.
    static constexpr double accuracy = 1e-7;
};

TEST_P(Gradient, ForcesAndMomentsAreDerivativesOfTheEnergy) {
    const Packing packing = test::mixture_packing();
    const auto solver = test::solver_for(scenario(), packing);
    const test::Bodies bodies(*solver, packing);
    const test::State state = test::mixture_state(*solver);
    test::set_state(*solver, state);
    const GrainView v = solver->view(Need::contacts);
    ASSERT_GE(v.contacts.size(), 15U);  // 8 with walls, 8 between grains
    const test::Drive drive = test::drive_at(*solver, bodies, state);
    const double scale = drive.largest();
    ASSERT_GT(scale, 1e-2);
    double worst = 0.0;
    const auto compare = [&](double force, const std::function<void(test::State&, double)>& displace) {
        const double expected = -test::slope(
            [&](double h) {
                test::State moved = state;
                displace(moved, h);
                return test::elastic_energy_at(*solver, moved);
            },
            step);
        worst = std::max(worst, std::abs(force - expected) / scale);
    };
    for (std::size_t g = 0; g < packing.size(); ++g) {
        for (int a = 0; a < 2; ++a)
            compare(drive.force[g][a], [&](test::State& s, double h) { s.position[g][a] += h; });
        for (int a = 0; a < 4; ++a)
            compare(drive.moment[g](a / 2, a % 2),
                    [&](test::State& s, double h) { s.F[g](a / 2, a % 2) += h; });
    }
    RecordProperty("worst", fmt::format("{:.1e}", worst));
    EXPECT_LT(worst, accuracy);
}

TEST_P(Gradient, WallForcesAreDerivativesOfTheEnergy) {
    const Packing packing = test::mixture_packing();
    const auto solver = test::solver_for(scenario(), packing);
    test::set_state(*solver, test::mixture_state(*solver));
    const std::array<Vec2, 4> force = solver->wall_force();
    double scale = 0.0;
    for (const Vec2& f : force) scale = std::max(scale, f.norm());
    for (std::size_t w = 0; w < 4; ++w) {
        const double expected = -test::slope(
            [&](double h) {
                Box moved = packing.box;
                moved.position[w] += h;
                test::set_box(*solver, moved);
                return solver->view(Need::base).energy.elastic;
            },
            step);
        EXPECT_NEAR(force[w][wall_axis(static_cast<int>(w))], expected, accuracy * scale) << wall_names[w];
        EXPECT_EQ(force[w][1 - wall_axis(static_cast<int>(w))], 0.0);
    }
}
INSTANTIATE_TEST_SUITE_P(Laws, Gradient,
                         testing::Values(Case{"neo_hookean", "neo_hookean", 0.3, 0.45, 0.0},
                                         Case{"linear", "linear", 0.3, 0.0, 0.0},
                                         Case{"nearly_incompressible", "neo_hookean", 0.49, 0.5, 0.0},
                                         Case{"cohesive", "neo_hookean", 0.2, 0.4, 0.05}),
                         [](const auto& row) { return std::string(row.param.name); });

TEST(LensPotential, DerivativesOfItsParts) {
    const double mu = 0.4, kappa = 1.3, h = 1e-4;
    for (double J : {0.3, 0.7, 1.0, 1.4}) {
        const double slope =
            test::slope([&](double d) { return LensPotential::dilation_energy(J + d, mu, kappa); }, h);
        EXPECT_NEAR(LensPotential::pressure(J, mu, kappa), -slope, 1e-9) << "J " << J;
    }
    EXPECT_EQ(LensPotential::pressure(1.0, mu, kappa), 0.0);
    EXPECT_NEAR(LensPotential::dilation_energy(1.0, mu, kappa), 0.0, 1e-15);
}

/// Overlaps of one grain's contacts, from two light ones to eight that fill it.
const std::vector<std::vector<double>> overlaps{{1e-7, 3e-5},
                                                {0.02},
                                                {1e-3, 2e-3, 1.5e-3, 2e-6},
                                                {0.01, 0.013, 0.008, 0.015, 0.004, 3e-4},
                                                {0.02, 0.01, 0.03, 0.02, 0.015, 0.02, 0.025, 0.01}};

LensPotential::Sums sums_of(const std::vector<double>& h) {
    LensPotential::Sums sums;
    for (double value : h) sums.add(LensPotential::overlap(value));
    return sums;
}

TEST(LensPotential, InflationAndItsDerivatives) {
    for (double nu : {0.0, 0.3, 0.5})
        for (const std::vector<double>& h : overlaps) {
            const double bulge = LensPotential::bulge(nu);
            const LensPotential::Inflation in = LensPotential::inflation(sums_of(h), bulge);
            for (std::size_t k = 0; k < h.size(); ++k) {
                const double slope = test::slope(
                    [&](double d) {
                        std::vector<double> moved = h;
                        moved[k] += d;
                        return LensPotential::inflation(sums_of(moved), bulge).G;
                    },
                    0.01 * h[k]);
                // Truncation: (1 %)^4 of the value.
                EXPECT_NEAR(in.slope(LensPotential::overlap(h[k])), slope, 1e-6 * slope + 1e-9)
                    << "nu " << nu << " h " << h[k];
            }
        }
}

TEST(LensPotential, InflationIsTheFormulaAsWritten) {
    using L = LensPotential;
    for (double nu : {0.0, 0.3, 0.5})
        for (const std::vector<double>& h : overlaps) {
            double base = 0.0, Q0 = 0.0, Q1 = 0.0, Q2 = 0.0, local = 0.0;
            for (double v : h) {
                const double rho = std::sqrt(v) / (std::sqrt(v) + L::r0);
                const double q0 = v / (v + L::s0) * rho, q1 = v / (v + L::s1) * rho;
                base += v * v / (v + L::s0), Q0 += q0, Q1 += q1, Q2 += q1 * q1, local += std::pow(v, 1.5);
            }
            const double a = 1.0 / (1.0 + std::pow(Q1 * Q1 / Q2 / L::n0, 8.0));
            const double b = 1.0 / (1.0 + std::pow(Q1 / L::Qc, 16.0));
            const double chi = (a - L::gamma * (1.0 - 2.0 * nu) / (1.0 - nu)) * b;
            const L::Sums sums = sums_of(h);
            const double G = base + L::s0 * Q0 * (1.0 - chi);
            EXPECT_NEAR(L::inflation(sums, L::bulge(nu)).G, G, 1e-14 * G);
            EXPECT_NEAR(L::contact_energy(3.0, 0.9, sums), 1.8 * local, 1e-14 * local);
        }
}

TEST(LensPotential, AGrainWithoutContactsIsNotInflated) {
    const LensPotential::Overlap none = LensPotential::overlap(0.0);
    for (double value : {none.r, none.base, none.q0, none.q1, none.base_slope, none.q0_slope, none.q1_slope})
        EXPECT_EQ(value, 0.0);
    const LensPotential::Inflation in = LensPotential::inflation(LensPotential::Sums{}, 0.1);
    EXPECT_EQ(in.G, 0.0);
    EXPECT_EQ(in.slope(none), 0.0);
    // The lightest touch is no step: force and its slope start from 0.
    const LensPotential::Inflation light = LensPotential::inflation(sums_of({1e-30}), 0.1);
    EXPECT_LT(light.G, 1e-30);
    EXPECT_LT(light.slope(LensPotential::overlap(1e-30)), 1e-10);
}

TEST(LensPotential, SlopesOfOverlapAndTheirOwn) {
    for (double h : {1e-7, 1e-4, 3e-3, 0.05}) {
        const LensPotential::Overlap o = LensPotential::overlap(h);
        const auto slope = [&](double LensPotential::Overlap::*part) {
            return test::slope([&](double d) { return LensPotential::overlap(h + d).*part; }, 0.01 * h);
        };
        EXPECT_NEAR(o.base_slope, slope(&LensPotential::Overlap::base), 1e-7 * o.base_slope);
        EXPECT_NEAR(o.q0_slope, slope(&LensPotential::Overlap::q0), 1e-7 * o.q0_slope);
        EXPECT_NEAR(o.q1_slope, slope(&LensPotential::Overlap::q1), 1e-7 * o.q1_slope);
        const LensPotential::Inflation in{0.0, 0.7, 2.0, 0.3};
        const double bend =
            test::slope([&](double d) { return in.slope(LensPotential::overlap(h + d)); }, 0.01 * h);
        EXPECT_NEAR(LensPotential::curvature(o, in), bend, 1e-6 * std::abs(bend));
    }
}

TEST(LensPotential, APairIsPressedByBothGrainsAlike) {
    // Grains of one size and material share the overlap; a small or soft one takes the larger share.
    const auto depth_of_change = [](double radius, double E_ratio) {
        Scenario s = test::default_scenario(0.3);
        test::switch_off_damping(s);
        test::add_classes(s, E_ratio, 0.3);
        Packing p =
            test::packing_of(test::far_away(), {{0.0, 0.0}, {0.97 * (1.0 + radius), 0.0}}, {1.0, radius});
        p.grain_class = {0, 1};
        const auto solver = test::solver_for(s, p);
        const test::Bodies bodies(*solver, p);
        const test::Drive drive = test::drive_at(*solver, bodies, test::state_of(*solver));
        EXPECT_NEAR((drive.force[0] + drive.force[1]).norm(), 0.0, 1e-15);
        EXPECT_GT(drive.force[1].x(), 0.0);
        // Moment per E A0: how much the grain is made to give way.
        const double area = std::numbers::pi * radius * radius;
        return std::pair{drive.moment[0](0, 0) / std::numbers::pi, drive.moment[1](0, 0) / (area * E_ratio)};
    };
    const auto equal = depth_of_change(1.0, 1.0);
    EXPECT_NEAR(equal.first, equal.second, 1e-13);
    const auto small = depth_of_change(0.3, 1.0);
    EXPECT_LT(small.second, 2.0 * small.first);  // compression is negative: the small one gives way more
    const auto hard = depth_of_change(1.0, 100.0);
    EXPECT_LT(hard.first, 50.0 * hard.second);
}

}  // namespace
}  // namespace softgrain::sdem
