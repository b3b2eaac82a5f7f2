// What should not happen often, and must not break anything.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"
#include "unit_pair.hpp"

namespace softgrain::sdem {
namespace {

TEST(HardCases, OverlapsFromABillionthToHalfAGrain) {
    double before = 0.0;
    for (double overlap : {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 0.1, 0.3, 0.5}) {
        const double distance = 2.0 - overlap;
        const auto solver = test::solver_for(
            test::undamped_scenario(),
            test::packing_of(test::far_away(), {{0.0, 0.0}, {0.6 * distance, 0.8 * distance}}, {1.0, 1.0}));
        const GrainView v = solver->view(Need::contacts);
        ASSERT_EQ(v.contacts.size(), 1U) << "overlap " << overlap;
        const double force = v.contacts[0].normal_force();
        // The overlap itself is known to the rounding of the centres: 2e-16 / overlap.
        EXPECT_NEAR(force / test::unit_pair_force(overlap, 0.3), 1.0, 1e-8 + 3e-15 / overlap)
            << "overlap " << overlap;
        EXPECT_GT(force, before);
        before = force;
    }
}

/// The error that the run ends with when it begins like this; no grain if it does not.
DivergedError error_of(const Packing& packing) {
    try {
        test::solver_for(test::undamped_scenario(), packing);
    } catch (const DivergedError& e) {
        return e;
    }
    return DivergedError(-1, "nothing", 0.0, "no error");
}

TEST(HardCases, ContainmentAndCoincidentCentresEndTheRun) {
    const DivergedError inside =
        error_of(test::packing_of(test::far_away(), {{5.0, 5.0}, {0.0, 0.0}, {0.1, 0.0}}, {1.0, 1.0, 0.3}));
    EXPECT_EQ(inside.grain, 1);
    EXPECT_EQ(inside.quantity, "contact");
    EXPECT_NE(std::string(inside.what()).find("grain 2"), std::string::npos);
    EXPECT_NE(std::string(inside.what()).find("inside"), std::string::npos);
    const DivergedError same =
        error_of(test::packing_of(test::far_away(), {{0.0, 0.0}, {0.0, 0.0}}, {1.0, 1.0}));
    EXPECT_EQ(same.grain, 0);
    EXPECT_NE(std::string(same.what()).find("coincide"), std::string::npos);
}

TEST(HardCases, CrossedEllipsesArePushedApart) {
    // Four points of intersection: the deepest pocket is the contact, until they are apart.
    Packing p = test::packing_of(test::far_away(), {{0.0, 0.0}, {0.9, 0.05}}, {1.0, 1.0});
    p.aspect_ratio = {2.5, 2.5};
    p.angle = {0.0, 0.5 * std::numbers::pi};
    auto solver = test::solver_for(test::default_scenario(0.3), p);
    const test::Bodies bodies(*solver, p);
    ASSERT_EQ(solver->view(Need::contacts).contacts.size(), 1U);
    for (int k = 0; k < 200; ++k) solver->advance(test::still(*solver), 0.1);
    solver->check_finite();
    const test::State s = test::state_of(*solver);
    EXPECT_GT(s.position[1].x() - s.position[0].x(), 1.8);
    EXPECT_TRUE(solver->view(Need::contacts).contacts.empty());
    const test::Momentum m = test::momentum_of(*solver, bodies);
    EXPECT_NEAR(m.linear.norm(), 0.0, 1e-13);
    EXPECT_NEAR(m.angular, 0.0, 1e-12);
}

/// Largest error of force and moment of one grain against the energy, in units of the largest.
double gradient_error(Solver& solver, const Packing& packing, const test::State& state, std::size_t g,
                      double step) {
    const test::Bodies bodies(solver, packing);
    const test::Drive drive = test::drive_at(solver, bodies, state);
    double worst = 0.0;
    for (int a = 0; a < 6; ++a) {
        const auto energy = [&](double h) {
            test::State moved = state;
            (a < 2 ? moved.position[g][a] : moved.F[g]((a - 2) / 2, a % 2)) += h;
            return test::elastic_energy_at(solver, moved);
        };
        const double force = a < 2 ? drive.force[g][a] : drive.moment[g]((a - 2) / 2, a % 2);
        worst = std::max(worst, std::abs(force + test::slope(energy, step)) / drive.largest());
    }
    return worst;
}

TEST(HardCases, StrainsOfSixtyPercent) {
    const Packing packing = test::packing_of(test::far_away(), {{0.0, 0.0}, {1.1, 1.2}}, {1.0, 0.9});
    auto solver = test::solver_for(test::undamped_scenario(), packing);
    test::State state = test::state_of(*solver);
    state.F[0] = test::rotation(0.5) * Vec2{1.6, 0.7}.asDiagonal() * test::rotation(0.2);
    state.F[1] = test::rotation(-0.9) * Vec2{1.5, 0.6}.asDiagonal();
    test::set_state(*solver, state);
    ASSERT_EQ(solver->view(Need::contacts).contacts.size(), 1U);
    for (std::size_t g : {0U, 1U})
        EXPECT_LT(gradient_error(*solver, packing, state, g, 1e-4), 1e-7) << "grain " << g;
}

TEST(HardCases, AGrainTwentyTimesAsLarge) {
    Packing packing =
        test::packing_of(test::far_away(), {{0.0, 0.0}, {0.6, 0.848}, {-0.5, -0.4}}, {1.0, 0.05, 0.05});
    packing.center[2] = Vec2{-0.8, -0.62};
    auto solver = test::solver_for(test::undamped_scenario(), packing);
    const test::State state = test::state_of(*solver);
    ASSERT_EQ(solver->view(Need::contacts).contacts.size(), 2U);
    for (std::size_t g : {0U, 1U, 2U})
        EXPECT_LT(gradient_error(*solver, packing, state, g, 1e-5), 1e-7) << "grain " << g;
    const test::Bodies bodies(*solver, packing);
    const double energy = solver->view(Need::base).energy.elastic;
    for (int k = 0; k < 2000; ++k) solver->advance(test::still(*solver), 0.2 * solver->stable_time_step());
    const EnergyLedger e = solver->view(Need::base).energy;
    EXPECT_NEAR(e.kinetic + e.elastic, energy, 2e-2 * energy);
    const test::Momentum m = test::momentum_of(*solver, bodies);
    EXPECT_NEAR(m.linear.norm(), 0.0, 1e-15);
    EXPECT_NEAR(m.angular, 0.0, 1e-15);
}

TEST(HardCases, AGrainWithThirtyContacts) {
    Packing packing = test::packing_of(test::far_away(), {Vec2::Zero()}, {1.0});
    const double around = 2.0 * std::numbers::pi / 30.0;
    const double radius = std::sin(0.5 * around) / (1.0 - std::sin(0.5 * around));
    for (int k = 0; k < 30; ++k) {
        packing.center.push_back(0.99 * (1.0 + radius) * Vec2{std::cos(around * k), std::sin(around * k)});
        packing.radius.push_back(radius);
    }
    auto solver = test::solver_for(test::default_scenario(0.3), packing);
    int touching = 0;
    for (const GrainContact& c : solver->view(Need::contacts).contacts) touching += c.i == 0 ? 1 : 0;
    EXPECT_EQ(touching, 30);
    auto still = test::solver_for(test::undamped_scenario(), packing);
    EXPECT_LT(gradient_error(*still, packing, test::state_of(*still), 0, 1e-5), 1e-7);
    const double energy = solver->view(Need::base).energy.elastic;
    double before = energy;
    for (int k = 0; k < 500; ++k) {
        solver->advance(test::still(*solver), solver->stable_time_step());
        const EnergyLedger e = solver->view(Need::base).energy;
        EXPECT_LT(e.kinetic + e.elastic, 1.02 * before);  // dashpots only take
        before = std::max(e.kinetic + e.elastic, 1e-3 * energy);
    }
    EXPECT_LT(before, 0.5 * energy);
    EXPECT_NEAR(test::state_of(*solver).position[0].norm(), 0.0, 1e-6);
}

class FullCoverage : public testing::TestWithParam<double> {};

TEST_P(FullCoverage, APackingIsCompressedUntilItsGrainsFillMoreThanTheBox) {
    const double nu = GetParam();
    const Packing packing = test::packing24();
    auto solver = test::solver_for(test::default_scenario(nu), packing);
    const double grains = packing.packing_fraction_undeformed() * packing.box.area();
    double covered = 0.0, stress = 0.0;
    for (double fraction : {0.86, 0.9, 0.95, 0.999, 1.05, 1.1}) {
        test::close_to(*solver, std::sqrt(grains / fraction), 0.01);
        test::run(*solver, 200);
        const GrainView v = solver->view(Need::area);
        covered = v.covered_area / v.box.area();
        const double now = v.wall_force[1].x() / v.box.height();
        EXPECT_GT(now, 0.98 * stress);
        stress = now;
        EXPECT_LE(covered, fraction);  // the law squeezes material, it makes none
    }
    solver->check_finite();
    // Soft grains give way; what can hardly be compressed fills all, and more once the box is smaller.
    EXPECT_GT(covered, nu < 0.4 ? 0.9 : 0.999);
    RecordProperty("covered", fmt::format("{:.5f}", covered));
    RecordProperty("stress", fmt::format("{:.3f}", stress));
}
INSTANTIATE_TEST_SUITE_P(Poisson, FullCoverage, testing::Values(0.0, 0.3, 0.49, 0.5));

/// A packing at rest at this undeformed fraction, made at the default settings.
Checkpoint compacted(double nu, double fraction) {
    const Packing packing = test::packing24();
    auto solver = test::solver_for(test::default_scenario(nu), packing);
    test::close_to(*solver, std::sqrt(packing.packing_fraction_undeformed() * packing.box.area() / fraction),
                   0.02);
    test::run(*solver, 3000);
    Checkpoint rest;
    solver->save(rest);
    return rest;
}

/// Does a step of `share` of the stability limit go well for this packing, a little stirred?
bool stable(double nu, double damping, const Checkpoint& rest, double share) {
    Scenario s = test::default_scenario(nu);
    test::settings(s).set("contact_damping", damping);
    test::settings(s).set("shape_damping", 0.5 * damping);
    test::settings(s).set("safety", 1.0);
    auto solver = test::solver_for(s, test::packing24());
    solver->load(rest);
    const WallMotion walls = test::still(*solver);
    for (int k = 0; k < 16; ++k) solver->advance(walls, 1e-9);  // the limit is looked at again
    test::State state = test::state_of(*solver);
    for (std::size_t g = 0; g < state.velocity.size(); ++g)
        state.velocity[g] += 1e-4 * Vec2{std::cos(2.3 * static_cast<double>(g)), 0.7};
    test::set_state(*solver, state);
    const EnergyLedger start = solver->view(Need::base).energy;
    const double dt = share * solver->stable_time_step();
    try {
        for (int k = 0; k < 2000; ++k) solver->advance(walls, dt);
    } catch (const DivergedError&) {
        return false;
    }
    const EnergyLedger end = solver->view(Need::base).energy;
    const double gain = end.kinetic + end.elastic - start.kinetic - start.elastic;
    return gain < 0.05 * start.kinetic;
}

class DefaultTimeStep : public testing::TestWithParam<double> {};

TEST_P(DefaultTimeStep, IsStable) {
    const double nu = GetParam();
    for (double fraction : {0.86, 0.99}) {
        const Checkpoint rest = compacted(nu, fraction);
        for (double damping : {0.0, 0.5, 1.0})
            EXPECT_TRUE(stable(nu, damping, rest, 0.8)) << "gamma " << damping << " fraction " << fraction;
    }
}
INSTANTIATE_TEST_SUITE_P(Poisson, DefaultTimeStep, testing::Values(0.0, 0.2, 0.3, 0.4, 0.45, 0.49, 0.5));

TEST(Watchdog, CatchesAStepAboveTheLimit) {
    // At four times the limit nothing can be stable; the run must end with an error, not with numbers.
    const Checkpoint rest = compacted(0.3, 0.9);
    for (double damping : {0.0, 1.0})
        for (double share : {4.0, 8.0, 30.0}) {
            Scenario s = test::default_scenario(0.3);
            test::settings(s).set("contact_damping", damping);
            test::settings(s).set("shape_damping", 0.5 * damping);
            auto solver = test::solver_for(s, test::packing24());
            solver->load(rest);
            const WallMotion walls = test::still(*solver);
            const double dt = share / 0.8 * solver->stable_time_step();
            EXPECT_THROW(
                {
                    for (int k = 0; k < 3000; ++k) solver->advance(walls, dt);
                },
                DivergedError)
                << "damping " << damping << " share " << share;
        }
}

TEST(HardCases, AGrainThatComesApartEndsTheRun) {
    // Not an error of the input, even where such a grain no longer fits into a periodic cell.
    for (bool periodic : {false, true}) {
        Packing packing = test::packing24();
        if (periodic)
            packing.box.periodic = true;
        else
            packing = test::packing_of(test::far_away(), std::vector<Vec2>(8, Vec2::Zero()),
                                       std::vector<double>(8, 1.0));
        for (std::size_t g = 0; !periodic && g < 8; ++g)
            packing.center[g].x() = 20.0 * (static_cast<double>(g) - 4.0);
        auto solver = test::solver_for(test::undamped_scenario(), packing);
        test::State state = test::state_of(*solver);
        state.F_rate[7] << 20.0, 0.0, 0.0, 20.0;
        test::set_state(*solver, state);
        try {
            for (int k = 0; k < 20; ++k) solver->advance(test::still(*solver), periodic ? 0.1 : 0.25);
            FAIL() << "a grain grew without end";
        } catch (const DivergedError& e) {
            EXPECT_EQ(e.grain, 7);
            EXPECT_EQ(e.quantity, "F");
        }
    }
}

TEST(HardCases, AMillionStepsAtRestChangeNothing) {
    const Packing packing =
        test::packing_of(Box{{0.0, 3.9, 0.0, 1.95}}, {{0.98, 0.97}, {2.92, 0.98}}, {1.0, 1.0});
    auto solver = test::solver_for(test::default_scenario(0.3), packing);
    test::run(*solver, 20000);
    const test::State before = test::state_of(*solver);
    const EnergyLedger start = solver->view(Need::base).energy;
    const std::array<Vec2, 4> force = solver->wall_force();
    const WallMotion walls = test::still(*solver);
    const double dt = solver->stable_time_step();
    for (int k = 0; k < 1000000; ++k) solver->advance(walls, dt);
    const test::State after = test::state_of(*solver);
    for (std::size_t g = 0; g < 2; ++g) {
        EXPECT_NEAR((after.position[g] - before.position[g]).norm(), 0.0, 1e-12);
        // Without friction nothing stops the spin that the first steps left.
        EXPECT_NEAR((after.F[g].transpose() * after.F[g] - before.F[g].transpose() * before.F[g]).norm(), 0.0,
                    1e-12);
    }
    const EnergyLedger end = solver->view(Need::base).energy;
    EXPECT_NEAR(end.elastic, start.elastic, 1e-13);
    EXPECT_LT(end.kinetic, 1e-15);
    EXPECT_NEAR(end.kinetic, start.kinetic, 1e-4 * start.kinetic);
    EXPECT_NEAR(end.damping, start.damping, 1e-13);
    for (std::size_t w = 0; w < 4; ++w) EXPECT_NEAR((solver->wall_force()[w] - force[w]).norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace softgrain::sdem
