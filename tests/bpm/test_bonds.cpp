#include "bpm/bonds.hpp"

#include <gtest/gtest.h>

#include <random>

#include "bpm/grain_compression.hpp"
#include "common/errors.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

/// Two grains of 5 x 5 discs on a square lattice, apart from each other.
struct Lattice {
    std::vector<Vec2> x, v;
    std::vector<double> radius, mass;
    std::vector<int> grain;

    Lattice() {
        std::mt19937_64 random(3);
        std::uniform_real_distribution<double> unit(-1.0, 1.0);
        for (int g = 0; g < 2; ++g)
            for (int row = 0; row < 5; ++row)
                for (int column = 0; column < 5; ++column) {
                    x.emplace_back(column + 5.05 * g, row);
                    v.emplace_back(unit(random), unit(random));
                    radius.push_back(0.48 + 0.02 * unit(random));
                    mass.push_back(1.0 + 0.3 * unit(random));
                    grain.push_back(g);
                }
    }
    Bonds bonds(BondLaw law) const {
        law.reach = 0.2;
        return {law, x, radius, mass, grain};
    }
    /// Every disc moved by up to `size`.
    std::vector<Vec2> shaken(double size) const {
        std::mt19937_64 random(7);
        std::uniform_real_distribution<double> unit(-size, size);
        std::vector<Vec2> moved = x;
        for (Vec2& place : moved) place += Vec2(unit(random), unit(random));
        return moved;
    }
};

TEST(Bonds, JoinNeighboursOfAGrain) {
    const Lattice lattice;
    const Bonds bonds = lattice.bonds({});
    EXPECT_EQ(bonds.pairs().size(), 2U * 40U);
    for (const Pair& pair : bonds.pairs())
        EXPECT_EQ(lattice.grain[static_cast<std::size_t>(pair.i)],
                  lattice.grain[static_cast<std::size_t>(pair.j)]);
    EXPECT_EQ(bonds.energy(lattice.x), 0.0);
}

TEST(Bonds, ForceIsTheGradientOfTheEnergy) {
    const Lattice lattice;
    const Bonds bonds = lattice.bonds({.stiffness = 3.0});
    std::vector<Vec2> x = lattice.shaken(0.1), force(x.size());
    const std::vector<Vec2> at_rest(x.size(), Vec2::Zero());
    bonds.forces(x, at_rest, force);
    const double step = 1e-5;
    for (std::size_t d = 0; d < x.size(); d += 7)
        for (int axis = 0; axis < 2; ++axis) {
            const double here = x[d][axis];
            x[d][axis] = here + step;
            const double more = bonds.energy(x);
            x[d][axis] = here - step;
            const double less = bonds.energy(x);
            x[d][axis] = here;
            EXPECT_NEAR(force[d][axis], -(more - less) / (2.0 * step), 1e-9);
        }
}

TEST(Bonds, KeepMomentumAndDampRelativeMotionOnly) {
    const Lattice lattice;
    const Bonds bonds = lattice.bonds({.stiffness = 3.0, .damping = 0.4});
    const std::vector<Vec2> x = lattice.shaken(0.1);
    std::vector<Vec2> damped(x.size()), springs(x.size());
    bonds.forces(x, lattice.v, damped);
    bonds.forces(x, std::vector<Vec2>(x.size(), Vec2(1.0, -2.0)), springs);
    Vec2 sum = Vec2::Zero();
    double torque = 0.0, power = 0.0;
    for (std::size_t d = 0; d < x.size(); ++d) {
        sum += damped[d];
        torque += cross(x[d], damped[d]);
        power += (springs[d] - damped[d]).dot(lattice.v[d]);
    }
    EXPECT_LT(sum.norm(), 1e-13);
    EXPECT_NEAR(torque, 0.0, 1e-12);
    EXPECT_NEAR(bonds.damping_power(x, lattice.v, lattice.v), power, 1e-12);
    EXPECT_GT(power, 1.0);
}

TEST(Bonds, BreakWhereTheTensionIsTooLarge) {
    const Lattice lattice;
    Bonds bonds = lattice.bonds({.stiffness = 2.0, .strength = 0.1});
    EXPECT_LT(bonds.break_bonds(lattice.x), 0.0);
    // The right two columns of the first grain move away: five bonds, stretched by 0.06, hold 0.12 N.
    std::vector<Vec2> x = lattice.x;
    for (std::size_t d = 0; d < 25; ++d)
        if (x[d].x() > 2.5) x[d].x() += 0.06;
    EXPECT_NEAR(bonds.break_bonds(x), 5.0 * 0.5 * 2.0 * 0.06 * 0.06, 1e-14);
    EXPECT_EQ(bonds.broken(), 5U);
    EXPECT_EQ(bonds.pairs().size(), 75U);
    const std::vector<int> fragments = bonds.fragments();
    for (std::size_t d = 0; d < 50; ++d)
        EXPECT_EQ(fragments[d], d >= 25 ? 2 : lattice.x[d].x() > 2.5 ? 1 : 0) << "disc " << d;
    // Compression breaks nothing.
    for (Vec2& place : x) place *= 0.8;
    EXPECT_LT(bonds.break_bonds(x), 0.0);
}

TEST(Bonds, StableStepIsThatOfTheStiffestMode) {
    // Two discs: omega^2 = 2 k / m, and the bound of Gershgorin is exact.
    const std::vector<Vec2> x{{0, 0}, {1, 0}};
    const std::vector<double> radius{0.5, 0.5}, mass{3.0, 3.0};
    const std::vector<int> grain{0, 0};
    const Bonds bonds({.stiffness = 2.0, .reach = 0.1}, x, radius, mass, grain);
    EXPECT_NEAR(bonds.stable_time_step(mass), 2.0 / std::sqrt(2.0 * 2.0 / 3.0), 1e-12);
}

TEST(Bonds, AreStoredAndFoundAgain) {
    const Lattice lattice;
    Bonds bonds = lattice.bonds({.stiffness = 2.0, .strength = 0.05});
    const std::vector<Vec2> x = lattice.shaken(0.1);
    ASSERT_GT(bonds.break_bonds(x), 0.0);
    Checkpoint checkpoint;
    bonds.save(checkpoint, "b.");
    Bonds again = lattice.bonds({.stiffness = 2.0, .strength = 0.05});
    again.load(checkpoint, "b.");
    EXPECT_EQ(again.broken(), bonds.broken());
    EXPECT_EQ(again.energy(x), bonds.energy(x));
    EXPECT_EQ(again.fragments(), bonds.fragments());
    checkpoint.put("b.pairs", std::span<const int>(std::vector<int>{0, 24}));
    EXPECT_THROW(again.load(checkpoint, "b."), InputError);
}

/// One grain between two walls that close in; the lateral walls are far.
struct Press {
    BpmSolver solver;
    Box box;
    double height, h;

    Press(Scenario scenario)
        : solver(scenario, wide(square_packing(1, 1, 0.4))), h(solver.stable_time_step()) {
        box = wide(square_packing(1, 1, 0.4)).box;
        const auto [low, high] = extent_of_discs(solver, 1);
        box.position[2] = low;
        box.position[3] = high;
        height = high - low;
    }
    static Packing wide(Packing packing) {
        packing.box.position[0] -= 3.0;
        packing.box.position[1] += 3.0;
        return packing;
    }
    /// Moves the upper wall at `speed` until the strain of the run is `strain`.
    void go_to(double strain, double speed) {
        const double direction = box.height() > (1.0 - strain) * height ? -1.0 : 1.0;
        while (direction * (box.height() - (1.0 - strain) * height) < 0.0) {
            const WallMotion walls{box, {0.0, 0.0, 0.0, direction * speed}};
            solver.advance(walls, h);
            box = walls.after(h);
        }
    }
};

TEST(BondedGrain, GivesItsEnergyBack) {
    Press press(bonded_scenario_of(200));
    press.go_to(0.05, 5e-4);
    const EnergyLedger loaded = press.solver.view(Need::base).energy;
    EXPECT_GT(loaded.elastic, 0.9 * loaded.external_work);
    EXPECT_NEAR(loaded.external_work - loaded.kinetic - loaded.elastic - loaded.dissipated(), 0.0,
                1e-2 * loaded.external_work);
    press.go_to(0.0, 5e-4);
    const EnergyLedger back = press.solver.view(Need::base).energy;
    EXPECT_LT(back.elastic, 0.02 * loaded.elastic);
    EXPECT_LT(back.external_work, 0.1 * loaded.external_work);
    EXPECT_EQ(press.solver.bonds()->broken(), 0U);
}

TEST(BondedGrain, BreaksIntoFragmentsThatAreCounted) {
    Press press(bonded_scenario_of(200, 0.002));
    press.go_to(0.15, 5e-3);
    const std::vector<int> fragments = press.solver.bonds()->fragments();
    EXPECT_GT(press.solver.bonds()->broken(), 50U);
    EXPECT_GT(*std::max_element(fragments.begin(), fragments.end()), 0);
    const EnergyLedger energy = press.solver.view(Need::base).energy;
    EXPECT_GT(energy.plastic, 0.0);
    EXPECT_NEAR(energy.external_work - energy.kinetic - energy.elastic - energy.dissipated(), 0.0,
                2e-2 * energy.external_work);
}

}  // namespace
}  // namespace softgrain::bpm
