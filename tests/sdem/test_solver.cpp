// The seam: view, restart, threads, bad input.
#include <gtest/gtest.h>

#include <numbers>

#include "harness.hpp"
#include "sdem/solver.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::sdem {
namespace {

class Restart : public ::testing::TestWithParam<double> {};

TEST_P(Restart, ContinuesWithTheSameBits) {
    const Scenario scenario = test::scenario_with(GetParam());
    const auto close = [](Solver& solver, const Box& = {}) {
        test::run(solver, 700, 0.001);
        return solver.view(Need::base).box;
    };
    const auto look = [](Solver& straight, Solver& restarted) {
        const GrainView a = straight.view(Need::all), b = restarted.view(Need::all);
        ASSERT_EQ(a.contacts.size(), b.contacts.size());
        ASSERT_GT(a.contacts.size(), 40U);
        for (std::size_t k = 0; k < a.contacts.size(); ++k)
            EXPECT_EQ(a.contacts[k].force, b.contacts[k].force);
        EXPECT_EQ(a.energy.elastic, b.energy.elastic);
        EXPECT_EQ(straight.wall_force(), restarted.wall_force());
    };
    testing::expect_restart_keeps_bits([&] { return test::solver_for(scenario, test::packing24()); }, close,
                                       close, look);
}
INSTANTIATE_TEST_SUITE_P(Poisson, Restart, ::testing::Values(0.3, 0.5));

TEST(Threads, SameBitsForOneAndTwo) {
    const Packing packing = test::touching_lattice(29);
    testing::expect_threads_keep_bits([&] { return test::solver_for(test::scenario_with(0.3), packing); },
                                      {1, 2}, [](Solver& solver) { test::run(solver, 150, 0.05); });
}

TEST(View, ContactsAreSortedAndBalanced) {
    auto solver = test::solver_for(test::scenario_with(0.3), test::packing24());
    test::close_to(*solver, 9.3, 0.005);
    test::run(*solver, 3000);
    const GrainView v = solver->view(Need::all);
    ASSERT_EQ(v.size(), 24U);
    std::vector<Vec2> sum(24, Vec2::Zero());
    std::array<Vec2, 4> on_wall{};
    on_wall.fill(Vec2::Zero());
    Mat2 love_weber = Mat2::Zero();
    for (std::size_t k = 0; k < v.contacts.size(); ++k) {
        const GrainContact& c = v.contacts[k];
        if (k > 0) {
            const GrainContact& b = v.contacts[k - 1];
            EXPECT_TRUE(b.i < c.i || (b.i == c.i && b.j < c.j));
        }
        EXPECT_NEAR(c.normal.norm(), 1.0, 1e-12);
        EXPECT_GE(c.normal_force(), 0.0);
        EXPECT_GT(c.length, 0.0);
        const auto i = static_cast<std::size_t>(c.i);
        sum[i] += c.force;
        if (c.with_wall()) {
            EXPECT_EQ(c.normal, Vec2{-wall_normal(c.wall())});
            on_wall[static_cast<std::size_t>(c.wall())] -= c.force;
            love_weber -= c.force * (c.point - v.centroid[i]).transpose() / v.box.area();
        } else {
            EXPECT_GT(c.j, c.i);
            const auto j = static_cast<std::size_t>(c.j);
            sum[j] -= c.force;
            love_weber += c.force * (v.centroid[i] - v.centroid[j]).transpose() / v.box.area();
        }
    }
    double typical = 0.0;
    for (std::size_t w = 0; w < 4; ++w) {
        EXPECT_NEAR((on_wall[w] - v.wall_force[w]).norm(), 0.0, 1e-14);
        typical += 0.25 * v.wall_force[w].norm();
    }
    for (const Vec2& f : sum) EXPECT_LT(f.norm(), 1e-3 * typical);
    // Wall stress and Love-Weber stress agree at equilibrium.
    EXPECT_NEAR(love_weber(0, 0), v.wall_force[1].x() / v.box.height(), 1e-3 * love_weber(0, 0));
    EXPECT_NEAR(love_weber(1, 1), v.wall_force[3].y() / v.box.width(), 1e-3 * love_weber(1, 1));
    // So does the sum of the grains' own stresses.
    Mat2 mean = Mat2::Zero();
    for (std::size_t g = 0; g < 24; ++g) mean += v.area[g] * v.stress[g] / v.box.area();
    EXPECT_NEAR((mean - 0.5 * (love_weber + love_weber.transpose())).norm(), 0.0, 1e-3 * mean.norm());
    EXPECT_GT(mean.trace(), 0.0);
    // Outlines enclose the areas; nothing sticks out of the box.
    for (std::size_t g = 0; g < 24; ++g) {
        double twice = 0.0;
        const auto from = static_cast<std::size_t>(v.outline_offset[g]);
        const auto to = static_cast<std::size_t>(v.outline_offset[g + 1]);
        for (std::size_t k = from; k < to; ++k) {
            const Vec2 a = v.outline_point[k], b = v.outline_point[k + 1 < to ? k + 1 : from];
            twice += cross(a, b);
            for (int w = 0; w < 4; ++w) EXPECT_GT(v.box.distance(w, a), -1e-12);
        }
        EXPECT_NEAR(0.5 * twice, v.area[g], 4e-3 * v.area[g]);  // 64 nodes
    }
    ASSERT_EQ(v.fields.size(), 7U);
    for (const Field& f : v.fields) EXPECT_EQ(f.values.size(), 24U * static_cast<std::size_t>(f.components));
    EXPECT_FALSE(solver->outside_validity().has_value());
}

TEST(View, StressOfOneGrainUnderFourWalls) {
    auto solver = test::solver_for(test::scenario_with(0.3), test::single_grain());
    test::close_to(*solver, 0.9, 1e-3);
    test::run(*solver, 500);
    const GrainView v = solver->view(Need::stress | Need::area);
    const double N = v.wall_force[1].x();
    EXPECT_NEAR(v.stress[0](0, 0), 2.0 * N * 0.45 / v.area[0], 1e-12);
    EXPECT_NEAR(v.stress[0](0, 1), 0.0, 1e-12);
    EXPECT_EQ(v.covered_area, v.area[0]);
}

TEST(Input, BadPackingsAndMaterialsAreRefusedWithACure) {
    const auto refusal = [](const Scenario& s, const Packing& p) {
        try {
            test::solver_for(s, p);
        } catch (const InputError& e) {
            return std::string(e.what());
        }
        return std::string("not refused");
    };
    Scenario s = test::scenario_with(0.3);
    EXPECT_NE(refusal(s, Packing{}).find("packing.path"), std::string::npos);
    s.material.poisson_ratio = 0.6;
    EXPECT_NE(refusal(s, test::single_grain()).find("0 to 0.5"), std::string::npos);
    s = test::scenario_with(0.3);
    s.material.yield_stress = 0.1;
    EXPECT_NE(refusal(s, test::single_grain()).find("lens_potential"), std::string::npos);
    s = test::default_scenario(0.3);
    s.material.yield_stress = 0.1;
    test::settings(s).set("kinematics", std::string("D2F1"));
    EXPECT_NE(refusal(s, test::single_grain()).find("D2F3"), std::string::npos);
    s = test::scenario_with(0.3);
    s.classes.resize(2);
    s.classes[1].material.poisson_ratio = 0.5;
    EXPECT_NE(refusal(s, test::single_grain()).find("lens_potential"), std::string::npos);
}

TEST(Input, ACheckpointOfAnotherPackingIsRefused) {
    auto one = test::solver_for(test::scenario_with(0.3), test::single_grain());
    auto many = test::solver_for(test::scenario_with(0.3), test::packing24());
    EXPECT_THROW(many->load(testing::saved(*one)), InputError);
}

TEST(Input, ContainedGrainsAreReported) {
    const Packing p = test::packing_of(test::far_away(), {{0.0, 0.0}, {0.1, 0.0}}, {1.0, 0.3});
    try {
        test::solver_for(test::scenario_with(0.3), p);
        FAIL();
    } catch (const DivergedError& e) {
        EXPECT_EQ(e.grain, 0);
        EXPECT_EQ(e.quantity, "contact");
    }
}

TEST(Validity, StrongStrainIsNamed) {
    auto solver =
        test::solver_for(test::scenario_with(0.3), test::packing_of(test::far_away(), {Vec2::Zero()}, {1.0}));
    EXPECT_FALSE(solver->outside_validity().has_value());
    test::State s = test::state_of(*solver);
    s.F[0] << 1.7, 0.0, 0.0, 0.8;
    test::set_state(*solver, s);
    ASSERT_TRUE(solver->outside_validity().has_value());
    EXPECT_NE(solver->outside_validity()->find("grain 0"), std::string::npos);
}

TEST(Neighbours, ARebuildKeepsEveryContact) {
    // Grains drift far across the box: the list is rebuilt many times, contacts compared with all pairs.
    Scenario s = test::scenario_with(0.3);
    test::settings(s).set("skin", 0.05);
    auto solver = test::solver_for(s, test::touching_lattice(5));
    test::State state = test::state_of(*solver);
    for (std::size_t g = 0; g < state.velocity.size(); ++g)
        state.velocity[g] =
            0.3 * Vec2{std::cos(2.3 * static_cast<double>(g)), std::sin(2.3 * static_cast<double>(g))};
    test::set_state(*solver, state);
    for (int round = 0; round < 30; ++round) {
        test::run(*solver, 10);
        const test::State now = test::state_of(*solver);
        std::size_t expected = 0;
        const Packing p = test::touching_lattice(5);
        for (std::size_t i = 0; i < now.position.size(); ++i)
            for (std::size_t j = i + 1; j < now.position.size(); ++j) {
                WarmStart cold;
                expected += chord_of(make_ellipse(now.position[i], now.F[i], p.radius[i]),
                                     make_ellipse(now.position[j], now.F[j], p.radius[j]), cold)
                                .touching();
            }
        std::size_t found = 0;
        for (const GrainContact& c : solver->view(Need::contacts).contacts) found += c.with_wall() ? 0 : 1;
        EXPECT_EQ(found, expected);
    }
}

}  // namespace
}  // namespace softgrain::sdem
