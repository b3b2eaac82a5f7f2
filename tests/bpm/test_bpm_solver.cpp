#include <gtest/gtest.h>
#include <omp.h>

#include "common/errors.hpp"
#include "sample.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::bpm {
namespace {

/// Steps with walls closing in at `speed`; returns the box at the end.
Box compact(BpmSolver& solver, Box box, double speed, int steps) {
    const double h = solver.stable_time_step();
    for (int k = 0; k < steps; ++k) {
        const WallMotion walls = closing(box, speed);
        solver.advance(walls, h);
        box = walls.after(h);
    }
    return box;
}

TEST(BpmSolver, ARelaxedGrainStaysPut) {
    BpmSolver solver(scenario_of(100), square_packing(1, 1, 1.0));
    const std::vector<Vec2> before(solver.disc_position().begin(), solver.disc_position().end());
    const std::vector<Vec2> centroid(solver.view(Need::base).centroid.begin(),
                                     solver.view(Need::base).centroid.end());
    compact(solver, square_packing(1, 1, 1.0).box, 0.0, 500);
    double moved = 0.0;
    for (std::size_t d = 0; d < before.size(); ++d)
        moved = std::max(moved, (solver.disc_position()[d] - before[d]).norm());
    // The contact tolerance (1e-4 d) lets single discs at the surface creep; 500 steps are 35 sqrt(m d/F0).
    EXPECT_LT(moved / solver.mean_disc_diameter(), 0.05);
    const GrainView view = solver.view(Need::base);
    EXPECT_LT((view.centroid[0] - centroid[0]).norm() / solver.mean_disc_diameter(), 1e-9);
    EXPECT_EQ(view.energy.external_work, 0.0);
    for (const Vec2& force : view.wall_force) EXPECT_EQ(force, Vec2::Zero());
}

TEST(BpmSolver, ContactsAndAttractionConserveMomentum) {
    // Grains meet after a push by the walls; then the walls stop far away: momentum changes only by wall
    // impulses.
    const Packing packing = square_packing(2, 2, 0.15);
    BpmSolver solver(scenario_of(40), packing);
    const auto momentum = [&] {
        const GrainView view = solver.view(Need::base);
        Vec2 sum = Vec2::Zero();
        for (std::size_t g = 0; g < view.size(); ++g) sum += view.mass[g] * view.velocity[g];
        return sum;
    };
    Box box = packing.box;
    const double h = solver.stable_time_step();
    Vec2 impulse = Vec2::Zero();
    double largest = 0.0;
    for (int k = 0; k < 150; ++k) {
        const WallMotion walls{box, {0.08, -0.02, 0.05, 0.0}};
        solver.advance(walls, h);
        box = walls.after(h);
        for (const Vec2& force : solver.wall_force()) {
            impulse -= h * force;
            largest = std::max(largest, force.norm());
        }
    }
    EXPECT_GT(largest, 0.1);
    EXPECT_LT((momentum() - impulse).norm(), 1e-12);
}

TEST(BpmSolver, EnergyLedgerCloses) {
    for (double friction : {0.0, 0.4}) {
        const Packing packing = square_packing(2, 2, 0.1);
        BpmSolver solver(scenario_of(60, 1, friction), packing);
        compact(solver, packing.box, 0.03, 500);
        const EnergyLedger energy = solver.view(Need::base).energy;
        const double residual = energy.external_work - energy.kinetic - energy.elastic - energy.dissipated();
        EXPECT_GT(energy.external_work, 0.05);
        EXPECT_GT(energy.impact, 0.0);
        // What is left is the error of integrating the attraction, measured 1e-4 to 1e-3 of the work.
        EXPECT_LT(std::abs(residual), 5e-3 * energy.external_work) << "friction " << friction;
        if (friction > 0.0)
            EXPECT_GT(energy.friction, 0.0);
        else
            EXPECT_EQ(energy.friction, 0.0);
    }
}

/// Two discs held together by their attraction spin against each other: their rims do not slip, so only the
/// resistance to rolling takes energy.
TEST(BpmSolver, RollingResistanceTakesEnergyAsFriction) {
    Scenario scenario = scenario_of(2);
    for (const char* key : {"friction_within", "rolling_resistance"})
        scenario.method_settings.at("bpm").set(key, 0.5);
    Packing packing = square_packing(1, 1, 1.0);
    BpmSolver solver(scenario, packing);
    Checkpoint checkpoint;
    solver.save(checkpoint);
    checkpoint.numbers.at("bpm.rim_speed") = {0.1, -0.1};
    solver.load(checkpoint);
    const double start = solver.view(Need::base).energy.kinetic;
    for (int k = 0; k < 100; ++k) solver.advance({packing.box, {}}, solver.stable_time_step());
    const EnergyLedger energy = solver.view(Need::base).energy;
    EXPECT_GT(start, 1e-3);
    EXPECT_LT(energy.kinetic, 0.01 * start);  // unequal discs go on turning together
    EXPECT_NEAR(energy.friction + energy.kinetic, start, 1e-4 * start);
    EXPECT_NEAR(energy.impact, 0.0, 1e-4 * start);
}

TEST(BpmSolver, RollingResistanceWithoutFrictionDoesNothing) {
    const Packing packing = square_packing(2, 1, 0.1);
    Scenario scenario = scenario_of(40);
    BpmSolver without(scenario, packing);
    scenario.method_settings.at("bpm").set("rolling_resistance", 0.5);
    BpmSolver with(scenario, packing);
    compact(without, packing.box, 0.03, 200);
    compact(with, packing.box, 0.03, 200);
    EXPECT_TRUE(std::ranges::equal(with.disc_position(), without.disc_position()));
}

TEST(BpmSolver, RestartGivesTheSameBits) {
    const Packing packing = square_packing(2, 2, 0.1);
    const Scenario scenario = scenario_of(40, 3, 0.3);
    BpmSolver solver(scenario, packing);
    Box box = compact(solver, packing.box, 0.03, 200);
    Checkpoint checkpoint;
    solver.save(checkpoint);
    BpmSolver again(scenario, packing);
    again.load(checkpoint);
    const auto expect_same = [&] {
        const GrainView a = solver.view(Need::all | Need::parts);
        const std::vector<GrainContact> contacts(a.contacts.begin(), a.contacts.end());
        const GrainView b = again.view(Need::all | Need::parts);
        EXPECT_TRUE(std::ranges::equal(solver.disc_position(), again.disc_position()));
        EXPECT_TRUE(std::ranges::equal(a.velocity, b.velocity));
        EXPECT_EQ(a.wall_force, b.wall_force);
        EXPECT_EQ(a.time, b.time);
        EXPECT_EQ(a.covered_area, b.covered_area);
        EXPECT_TRUE(std::ranges::equal(a.parts.reference, b.parts.reference));
        for (std::size_t f = 0; f < a.fields.size(); ++f)
            EXPECT_TRUE(std::ranges::equal(a.fields[f].values, b.fields[f].values)) << a.fields[f].name;
        EXPECT_EQ(a.energy.elastic, b.energy.elastic);
        EXPECT_EQ(a.energy.impact, b.energy.impact);
        EXPECT_EQ(a.energy.friction, b.energy.friction);
        ASSERT_EQ(contacts.size(), b.contacts.size());
        for (std::size_t k = 0; k < contacts.size(); ++k) EXPECT_EQ(contacts[k].force, b.contacts[k].force);
    };
    expect_same();
    compact(solver, box, 0.03, 200);
    compact(again, box, 0.03, 200);
    expect_same();
}

TEST(BpmSolver, RefusesTheCheckpointOfOtherDiscs) {
    const Packing packing = square_packing(2, 1, 0.3);
    BpmSolver solver(scenario_of(20, 1), packing), other(scenario_of(20, 2), packing);
    Checkpoint checkpoint;
    solver.save(checkpoint);
    EXPECT_THROW(other.load(checkpoint), InputError);
}

TEST(BpmSolver, SameBitsForOneAndTwoThreads) {
    // 16 grains of 90 discs: above the sizes at which threads are used. Few steps: barriers are slow on a
    // busy machine.
    const Packing packing = square_packing(4, 4, 0.1);
    Scenario scenario = scenario_of(90);
    scenario.method_settings.at("bpm").set("tolerance", 1e-3);
    testing::expect_threads_keep_bits([&] { return std::make_unique<BpmSolver>(scenario, packing); }, {1, 2},
                                      [&](BpmSolver& solver) {
                                          compact(solver, packing.box, 0.3, 30);
                                          EXPECT_GT(solver.wall_force()[0].norm(), 0.0);
                                      });
}

TEST(BpmSolver, PreparationIsTheSameForOneAndTwoThreads) {
    std::vector<std::vector<Vec2>> results;
    for (int threads : {1, 2}) {
        omp_set_num_threads(threads);
        const BpmSolver solver(scenario_of(20), square_packing(3, 2, 0.3));
        results.emplace_back(solver.disc_position().begin(), solver.disc_position().end());
    }
    omp_set_num_threads(1);
    EXPECT_TRUE(std::ranges::equal(results[0], results[1]));
}

TEST(BpmSolver, PenetrationFollowsTheTolerance) {
    const Packing packing = square_packing(1, 1, 0.05);
    std::vector<double> penetration;
    for (double tolerance : {1e-3, 1e-4}) {
        Scenario scenario = scenario_of(80);
        scenario.method_settings.at("bpm").set("tolerance", tolerance);
        BpmSolver solver(scenario, packing);
        Box box = packing.box;
        double deepest = 0.0;
        for (int k = 0; k < 24; ++k) {
            box = compact(solver, box, 0.03, 10);
            deepest = std::max(deepest, solver.penetration());
        }
        penetration.push_back(deepest);
        EXPECT_LT(deepest, 3.0 * tolerance);
    }
    EXPECT_GT(penetration[0], 3.0 * penetration[1]);
}

TEST(BpmSolver, RefusesGrainsThatCannotBeParted) {
    const Packing apart = square_packing(2, 1, 0.1);
    const auto refusal = [&](const Vec2& second) {
        Packing packing = apart;
        packing.center[1] = second;
        try {
            BpmSolver(scenario_of(20), packing);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal(apart.center[1]), "");
    const double right_wall = apart.box.position[1];
    for (const Vec2& centre :
         {apart.center[0], Vec2(apart.center[0] + Vec2(0.2, 0.0)), Vec2(right_wall, apart.center[1].y()),
          Vec2(right_wall + 0.5, apart.center[1].y())}) {
        const std::string text = refusal(centre);
        EXPECT_NE(text.find("do not fit into the packing: two grains, or a grain and a wall"),
                  std::string::npos)
            << text;
        EXPECT_NE(text.find("start from a looser packing"), std::string::npos) << text;
    }
}

TEST(BpmSolver, TooFastAWallIsAnError) {
    const Packing packing = square_packing(1, 1, 0.1);
    BpmSolver solver(scenario_of(40), packing);
    try {
        compact(solver, packing.box, 50.0, 10);
        FAIL() << "no error";
    } catch (const DivergedError& error) {
        EXPECT_EQ(error.grain, 0);
    }
}

TEST(BpmSolver, OverCompactionIsOutsideItsValidity) {
    const Packing packing = square_packing(1, 1, 0.1);
    BpmSolver solver(scenario_of(40), packing);
    EXPECT_FALSE(solver.outside_validity().has_value());
    Box box = packing.box;
    const double side = std::sqrt(2.6);  // discs have an area of 2.7 = 0.86 pi
    for (int k = 0; k < 4000 && box.width() > side && !solver.outside_validity(); ++k)
        box = compact(solver, box, 0.05, 1);
    EXPECT_TRUE(solver.outside_validity().has_value());
}

}  // namespace
}  // namespace softgrain::bpm
