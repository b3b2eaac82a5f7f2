// The same answer by other ways: how chords are found, threads, restart, a turned sample.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::sdem {
namespace {

/// Largest difference of two samples' contact forces, in units of the largest force.
double difference(const GrainView& a, const GrainView& b) {
    if (a.contacts.size() != b.contacts.size()) return 1e30;
    double largest = 0.0, worst = 0.0;
    for (std::size_t k = 0; k < a.contacts.size(); ++k) {
        if (a.contacts[k].i != b.contacts[k].i || a.contacts[k].j != b.contacts[k].j) return 1e30;
        largest = std::max(largest, a.contacts[k].force.norm());
        worst = std::max(worst, (a.contacts[k].force - b.contacts[k].force).norm());
    }
    return worst / largest;
}

class Geometries : public ::testing::TestWithParam<const char*> {};

TEST_P(Geometries, GiveTheSameForces) {
    const auto contacts_by = [](const char* geometry) {
        Scenario s = test::default_scenario(0.3);
        test::settings(s).set("law", std::string(GetParam()));
        test::settings(s).set("geometry", std::string(geometry));
        test::add_classes(s, 2.0, 0.3);
        auto solver = test::solver_for(s, test::mixture_packing());
        test::State state = test::mixture_state(*solver);
        for (std::size_t g = 0; g < state.velocity.size(); ++g)  // dashpots at work
            state.velocity[g] = 0.01 * Vec2{std::cos(2.0 * static_cast<double>(g)), 0.5};
        test::set_state(*solver, state);
        solver->advance(test::still(*solver), 1e-6);  // from chords so near that the batch finds the next
        return solver;
    };
    const auto batch = contacts_by("batch"), scalar = contacts_by("scalar"), polygon = contacts_by("polygon");
    const GrainView v = batch->view(Need::contacts);
    ASSERT_GE(v.contacts.size(), 15U);
    const double to_scalar = difference(v, scalar->view(Need::contacts));
    EXPECT_LT(to_scalar, 1e-12);
    EXPECT_GT(to_scalar, 0.0);  // the batch was at work
    RecordProperty("scalar", fmt::format("{:.1e}", to_scalar));
    const double to_polygon = difference(v, polygon->view(Need::contacts));
    EXPECT_LT(to_polygon, 0.01);  // 360 sides; overlaps here are around 0.05 R
    EXPECT_GT(to_polygon, 0.0);
    RecordProperty("polygon", fmt::format("{:.1e}", to_polygon));
}
INSTANTIATE_TEST_SUITE_P(Laws, Geometries, ::testing::Values("lens_potential", "mollon2022"));

/// Everything that has a memory at once: friction, adhesion, plastic flow, classes, ellipses.
Scenario everything() {
    Scenario s = test::default_scenario(0.3);
    s.material.friction = 0.3;
    s.material.wall_friction = 0.2;
    s.material.cohesion = 0.01;
    s.material.yield_stress = 0.05;
    test::settings(s).set("adhesion_range", 0.002);
    test::add_classes(s, 2.0, 0.45);
    return s;
}
/// Two classes on a lattice of touching grains; every third an ellipse.
Packing mixed_lattice(int side) {
    Packing p = test::touching_lattice(side);
    for (int k = 0; k < side * side; ++k) {
        p.grain_class.push_back(static_cast<std::uint8_t>(k % 2));
        p.aspect_ratio.push_back(k % 3 == 0 ? 1.1 : 1.0);
        p.angle.push_back(k % 3 == 0 ? 0.3 * k : 0.0);
    }
    return p;
}
/// Uneven velocities, so that contacts slide.
void stir(Solver& solver, double speed) {
    test::State state = test::state_of(solver);
    for (std::size_t g = 0; g < state.velocity.size(); ++g) {
        const auto k = static_cast<double>(g);
        state.velocity[g] = speed * Vec2{std::cos(2.3 * k), std::sin(1.1 * k)};
    }
    test::set_state(solver, state);
}

TEST(Threads, AnyNumberGivesTheSameBits) {
    const Packing packing = mixed_lattice(29);
    testing::expect_threads_keep_bits([&] { return test::solver_for(everything(), packing); }, {1, 2, 3, 4},
                                      [](Solver& solver) {
                                          stir(solver, 0.05);
                                          test::run(solver, 60, 0.05);
                                          const EnergyLedger e = solver.view(Need::base).energy;
                                          EXPECT_GT(e.friction, 0.0);
                                          EXPECT_GT(e.plastic, 0.0);
                                      });
}

class RestartOf : public ::testing::TestWithParam<bool> {};

TEST_P(RestartOf, ASampleWithEveryMemoryContinuesWithTheSameBits) {
    const bool periodic = GetParam();
    Packing packing = mixed_lattice(5);
    packing.box.periodic = periodic;
    const auto advance = [&](Solver& solver, int steps) {
        for (int k = 0; k < steps; ++k) {
            WallMotion motion = test::closing(solver.view(Need::base).box, 0.02);
            if (periodic) motion.tilt_rate = 0.2;
            solver.advance(motion, solver.stable_time_step());
        }
    };
    const auto first = [&](Solver& solver) {
        stir(solver, 0.05);
        advance(solver, 203);
        return solver.view(Need::base).box;
    };
    const auto look = [&](Solver& straight, Solver& restarted) {
        const GrainView a = straight.view(Need::all), b = restarted.view(Need::all);
        ASSERT_EQ(a.contacts.size(), b.contacts.size());
        ASSERT_GT(a.contacts.size(), 25U);
        double tangential = 0.0;
        for (std::size_t k = 0; k < a.contacts.size(); ++k) {
            EXPECT_EQ(a.contacts[k].force, b.contacts[k].force);
            tangential = std::max(tangential, std::abs(cross(a.contacts[k].normal, a.contacts[k].force)));
        }
        EXPECT_GT(tangential, 1e-4);
        EXPECT_EQ(a.energy.elastic, b.energy.elastic);
        EXPECT_EQ(a.energy.plastic, b.energy.plastic);
        EXPECT_EQ(a.energy.friction, b.energy.friction);
        if (periodic) {
            EXPECT_EQ(straight.cell_stress(), restarted.cell_stress());
        }
    };
    testing::expect_restart_keeps_bits([&] { return test::solver_for(everything(), packing); }, first,
                                       [&](Solver& solver, const Box&) { advance(solver, 200); }, look);
}
INSTANTIATE_TEST_SUITE_P(Box, RestartOf, ::testing::Values(false, true),
                         [](const auto& row) { return std::string(row.param ? "cell" : "walls"); });

TEST(Objectivity, ATurnedSampleWithEveryMemoryGivesTheTurnedResult) {
    const Packing packing = [] {
        Packing p = test::mixture_packing();
        p.box = test::far_away();
        return p;
    }();
    const Mat2 Q = test::rotation(0.7345);
    const auto result = [&](bool turn) {
        auto solver = test::solver_for(everything(), packing);
        test::State s = test::mixture_state(*solver);
        for (std::size_t g = 0; g < s.position.size(); ++g) {
            s.velocity[g] = 0.1 * (Vec2{1.8, 1.7} - s.position[g]);  // together
            s.F_rate[g] << 0.1, -0.2, 0.15, -0.05;
            if (turn) {
                s.position[g] = Q * s.position[g];
                s.velocity[g] = Q * s.velocity[g];
                s.F[g] = Q * s.F[g];
                s.F_rate[g] = Q * s.F_rate[g];
            }
        }
        test::set_state(*solver, s);
        for (int k = 0; k < 80; ++k) solver->advance(test::still(*solver), 0.02);
        return solver;
    };
    const auto plain = result(false), turned = result(true);
    const test::State a = test::state_of(*plain), b = test::state_of(*turned);
    for (std::size_t g = 0; g < packing.size(); ++g) {
        EXPECT_NEAR((Q * a.position[g] - b.position[g]).norm(), 0.0, 1e-11);
        EXPECT_NEAR((Q * a.F[g] - b.F[g]).norm(), 0.0, 1e-11);
        EXPECT_NEAR((Q * a.F_rate[g] - b.F_rate[g]).norm(), 0.0, 1e-10);
    }
    const EnergyLedger e = plain->view(Need::base).energy, f = turned->view(Need::base).energy;
    EXPECT_GT(e.plastic, 1e-4);
    EXPECT_GT(e.friction, 1e-5);
    EXPECT_NEAR(e.plastic, f.plastic, 1e-11);
    EXPECT_NEAR(e.friction, f.friction, 1e-11);
    EXPECT_NEAR(e.elastic, f.elastic, 1e-11);
}

}  // namespace
}  // namespace softgrain::sdem
