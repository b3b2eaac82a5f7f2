// Parts at rest that steps leave out.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "harness.hpp"
#include "sdem/solver.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::sdem {
namespace {

constexpr int columns = 160, rows = 16, settling = 300;
constexpr double radius = 0.5, rest_tolerance = 1e-4, tolerance = rest_tolerance * radius;

/// Discs pressed onto each other and onto the walls all around: five parts, one after the other along x.
Packing strip(bool periodic = false) {
    constexpr double spacing = 0.998;
    Packing p;
    for (int k = 0; k < columns * rows; ++k) {
        p.center.emplace_back(spacing * (0.5 + k % columns),
                              spacing * (0.5 + static_cast<double>(k / columns)));
        p.radius.push_back(radius);
    }
    p.box.position = {0.0, columns * spacing, 0.0, rows * spacing};
    p.box.periodic = periodic;
    return p;
}

/// Friction keeps the strip from buckling.
Scenario scenario(double rest, const char* law = "lens_potential") {
    Scenario s = test::default_scenario(0.3);
    s.material.friction = s.material.wall_friction = 0.5;
    test::settings(s).set("law", std::string(law));
    test::settings(s).set("rest_tolerance", rest);
    return s;
}

const RestingBlocks& rest_of(const Solver& solver) {
    return dynamic_cast<const SoftDiscSolver&>(solver).rest();
}
/// "r" for each part at rest, "." for the others.
std::string parts_of(const Solver& solver) {
    std::string parts;
    for (std::size_t p = 0; p < 5; ++p) parts += rest_of(solver).resting(p) ? 'r' : '.';
    return parts;
}

/// Steps with the left wall moving inwards.
void push(Solver& solver, int steps, double speed) {
    for (int k = 0; k < steps; ++k)
        solver.advance(WallMotion{solver.view(Need::base).box, {speed}}, solver.stable_time_step());
}

class Rest : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Laws, Rest, ::testing::Values("lens_potential", "mollon2022"));

TEST_P(Rest, LeavesOutPartsFarFromLoadAndKeepsTheResultToTheTolerance) {
    const auto result = [&](double rest) {
        auto solver = test::solver_for(scenario(rest, GetParam()), strip());
        push(*solver, settling, 0.0);
        push(*solver, 100, 1e-3);
        push(*solver, 100, 0.0);
        return solver;
    };
    const auto whole = result(0.0), part = result(rest_tolerance);
    EXPECT_EQ(rest_of(*whole).left_out(), 0);
    EXPECT_GE(rest_of(*part).left_out(), 3 * 200);  // of five parts, the three far from the wall
    EXPECT_EQ(parts_of(*part).substr(3), "rr");

    // A part at rest misses what its neighbours have moved since, at most the tolerance, and what it still
    // had to go: about as much, as it has been slower than that in 64 steps and the settled strip swings
    // little.
    constexpr double most = 2.0 * tolerance;
    const test::State a = test::state_of(*whole), b = test::state_of(*part);
    double moved = 0.0;
    for (std::size_t g = 0; g < a.position.size(); ++g) {
        moved = std::max(moved, (a.position[g] - b.position[g]).norm());
        EXPECT_LE(radius * (a.F[g] - b.F[g]).norm(), most);
    }
    EXPECT_LE(moved, most);
    EXPECT_GT(moved, 0.0);
    RecordProperty("moved", fmt::format("{:.2f} tolerances", moved / tolerance));
    // Contacts are at most 1/0.58 E stiff against the way of a wall (Eq. 57).
    for (std::size_t w = 0; w < 4; ++w) {
        const double stiffness = (w < 2 ? rows : columns) / 0.58;
        EXPECT_LE((whole->wall_force()[w] - part->wall_force()[w]).norm(), stiffness * most);
    }
    // What a contact's force would have done over that way, for the contacts between parts.
    const GrainView view = part->view(Need::contacts);
    double largest = 0.0;
    for (const GrainContact& contact : view.contacts) largest = std::max(largest, contact.force.norm());
    EXPECT_NEAR(test::residual(whole->view(Need::base).energy), test::residual(view.energy),
                4 * rows * largest * most);
}

TEST_P(Rest, EndsWhereADisturbanceArrives) {
    auto solver = test::solver_for(scenario(rest_tolerance, GetParam()), strip());
    push(*solver, settling, 0.0);
    ASSERT_EQ(parts_of(*solver).substr(1), "rrrr");
    push(*solver, 1, 1e-3);
    EXPECT_EQ(parts_of(*solver), ".rrrr");  // the wall moves
    push(*solver, 20, 1e-3);
    EXPECT_EQ(parts_of(*solver), "..rrr");  // grains at the wall have moved by more than the tolerance
    const test::State before = test::state_of(*solver);
    push(*solver, 1000, 1e-3);  // sound takes some 700 to the second part
    EXPECT_EQ(parts_of(*solver).back(), 'r');
    const test::State after = test::state_of(*solver);
    double moved = 0.0;
    for (std::size_t g = 0; g < after.position.size(); ++g)
        if (before.position[g].x() > 34.0)
            moved = std::max(moved, after.position[g].x() - before.position[g].x());
    EXPECT_GT(moved, 10.0 * tolerance);
}

struct Sample {
    const char* law;
    bool periodic;
};
class RestRestarted : public ::testing::TestWithParam<Sample> {};

TEST_P(RestRestarted, GivesTheSameBits) {
    const auto [law, periodic] = GetParam();
    Scenario s = scenario(rest_tolerance, law);
    s.material.cohesion = 1e-4;
    test::settings(s).set("adhesion_range", 0.002);
    const Packing packing = strip(periodic);
    std::string parts;
    const auto first = [&](Solver& solver) {
        if (periodic) {
            test::State state = test::state_of(solver);
            for (std::size_t g = 0; g < state.velocity.size(); ++g)
                if (state.position[g].x() < 10.0)
                    state.velocity[g] = 3e-4 * Vec2{std::cos(2.3 * static_cast<double>(g)), 0.0};
            test::set_state(solver, state);
        }
        for (int k = 0; k < settling && parts_of(solver).find('r') == std::string::npos; ++k)
            push(solver, 1, 0.0);
        if (!periodic) push(solver, 1, 1e-3);
        parts = parts_of(solver);
        EXPECT_NE(parts.find('r'), std::string::npos);
        EXPECT_NE(parts.find('.'), std::string::npos);
        return solver.view(Need::base).box;
    };
    const auto look = [&](Solver& straight, Solver& restarted) {
        EXPECT_EQ(parts_of(restarted), parts);
        EXPECT_EQ(straight.wall_force(), restarted.wall_force());
        EXPECT_EQ(straight.cell_stress(), restarted.cell_stress());
        EXPECT_EQ(straight.view(Need::all).energy.elastic, restarted.view(Need::all).energy.elastic);
    };
    testing::expect_restart_keeps_bits([&] { return test::solver_for(s, packing); }, first,
                                       [&](Solver& solver, const Box&) {
                                           push(solver, 150, periodic ? 0.0 : 1e-3);
                                           EXPECT_NE(parts_of(solver), parts);
                                       },
                                       look);
}
INSTANTIATE_TEST_SUITE_P(Samples, RestRestarted,
                         ::testing::Values(Sample{"lens_potential", false}, Sample{"mollon2022", false},
                                           Sample{"lens_potential", true}, Sample{"mollon2022", true}),
                         [](const auto& row) {
                             return std::string(row.param.law) + (row.param.periodic ? "_cell" : "_walls");
                         });

TEST(RestOf, AnyNumberOfThreadsIsTheSame) {
    testing::expect_threads_keep_bits([] { return test::solver_for(scenario(rest_tolerance), strip()); },
                                      {1, 2},
                                      [](Solver& solver) {
                                          push(solver, 150, 0.0);
                                          push(solver, 50, 1e-3);
                                          EXPECT_GT(rest_of(solver).left_out(), 0);
                                      });
}

TEST(RestOf, AFallingGrainNeverComes) {
    const auto left_out = [](double gravity) {
        Scenario s = scenario(0.1);
        s.box.gravity = Vec2{0.0, -gravity};
        auto solver = test::solver_for(s, test::packing_of(test::far_away(), {Vec2::Zero()}, {radius}));
        test::run(*solver, 500);
        return rest_of(*solver).left_out();
    };
    EXPECT_GT(left_out(0.0), 0);
    EXPECT_EQ(left_out(1e-7), 0);  // slow for all these steps
}

TEST(RestOf, NothingChangesNoBit) {
    const auto saved = [](const Scenario& s) {
        auto solver = test::solver_for(s, strip());
        push(*solver, 60, 1e-3);
        Checkpoint c = testing::saved(*solver);
        for (const char* name : {"resting_ways", "sdem.kept_at_rest"}) c.numbers.erase(name);
        c.integers.erase("resting_blocks");
        return c;
    };
    Scenario without = scenario(0.0);
    without.method_settings.at("sdem") = Settings(method().keys());
    const Checkpoint expected = saved(without);
    EXPECT_TRUE(testing::same_bits(expected, saved(scenario(0.0))));
    EXPECT_TRUE(testing::same_bits(expected, saved(scenario(1e-30))));  // too small for anything to rest
}

TEST(RestOf, WhatHasNoneIsRefused) {
    Scenario s = scenario(rest_tolerance);
    s.material.friction = s.material.wall_friction = 0.0;
    test::set_quasi_static(s, 1e-3);
    EXPECT_THROW(test::solver_for(s, test::packing24()), InputError);
    Scenario imposed = test::scenario_with(0.5);
    test::settings(imposed).set("rest_tolerance", rest_tolerance);
    EXPECT_THROW(test::solver_for(imposed, test::packing24()), InputError);
}

}  // namespace
}  // namespace softgrain::sdem
