// A periodic cell: images, stress, shear beyond one cell.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "mixture.hpp"

namespace softgrain::sdem {
namespace {

/// nx by ny grains on a hexagonal lattice with spacing 1, touching with a given overlap.
Packing crystal(int nx, int ny, double overlap, double disorder = 0.0) {
    Packing p;
    const double row = 0.5 * std::numbers::sqrt3;
    for (int y = 0; y < ny; ++y)
        for (int x = 0; x < nx; ++x) {
            const double k = (x % 4) + 4 * (y % 4);  // the same in every block of 4 x 4
            p.center.emplace_back(x + 0.5 * (y % 2) + 0.25 + disorder * std::sin(2.1 * k),
                                  row * y + 0.25 + disorder * std::cos(1.3 * k));
            p.radius.push_back(0.5 + 0.5 * overlap + 0.5 * disorder * std::sin(3.7 * k));
        }
    p.box.position = {0.0, static_cast<double>(nx), 0.0, row * ny};
    p.box.periodic = true;
    return p;
}
/// -1/A dE/d(strain) by carrying all centres along with the cell, F as they are.
Mat2 stress_by_energy(const Scenario& s, const Packing& packing) {
    const auto energy = [&](const Mat2& strain) {
        Packing p = packing;
        // The cell must stay upper triangular: turning it back costs nothing.
        const Mat2 map = Mat2::Identity() + strain;
        const Mat2 lattice = map * packing.box.lattice();
        p.box.position[1] = p.box.position[0] + lattice(0, 0);
        p.box.position[3] = p.box.position[2] + lattice(1, 1);
        p.box.tilt = lattice(0, 1);
        for (Vec2& c : p.center) c = packing.box.origin() + map * (c - packing.box.origin());
        return test::solver_for(s, p)->view(Need::base).energy.elastic;
    };
    Mat2 stress = Mat2::Zero();
    for (const auto& [a, b] : {std::pair{0, 0}, {0, 1}, {1, 1}}) {
        stress(a, b) = -test::slope(
                           [&, a = a, b = b](double h) {
                               Mat2 strain = Mat2::Zero();
                               strain(a, b) = h;
                               return energy(strain);
                           },
                           5e-5) /
                       packing.box.area();
    }
    return stress;
}

TEST(Cell, StressIsTheDerivativeOfTheEnergyAndSymmetric) {
    const Packing packing = crystal(4, 4, 0.06, 0.01);
    const auto solver = test::solver_for(test::undamped_scenario(), packing);
    const Mat2 stress = solver->cell_stress(),
               expected = stress_by_energy(test::undamped_scenario(), packing);
    EXPECT_GT(stress.trace(), 1e-2);
    EXPECT_NEAR(stress(0, 0), expected(0, 0), 1e-8);
    EXPECT_NEAR(stress(1, 1), expected(1, 1), 1e-8);
    EXPECT_NEAR(stress(0, 1), expected(0, 1), 1e-8);
}

TEST(Cell, StressIsTheVirialOfTheViewsContacts) {
    const Packing packing = crystal(4, 4, 0.06, 0.01);
    const auto solver = test::solver_for(test::undamped_scenario(), packing);
    const GrainView v = solver->view(Need::contacts);
    EXPECT_EQ(v.contacts.size(), 48U);  // six neighbours each
    Mat2 virial = Mat2::Zero();
    for (const GrainContact& c : v.contacts) {
        ASSERT_FALSE(c.with_wall());
        const auto i = static_cast<std::size_t>(c.i), j = static_cast<std::size_t>(c.j);
        const Vec2 branch = v.box.nearest(v.centroid[j] - v.centroid[i]);
        EXPECT_LT(branch.norm(), 1.1);
        EXPECT_GT(c.normal.dot(branch), 0.9);
        EXPECT_LT((c.point - v.centroid[i]).norm(), 0.6);  // near grain i
        virial -= c.force * branch.transpose() / v.box.area();
    }
    EXPECT_NEAR((virial - solver->cell_stress()).norm(), 0.0, 1e-14);
}

TEST(Cell, OneCellIsTheSameAsFourOfThem) {
    const auto compressed = [](int n) {
        Scenario s = test::default_scenario(0.3);
        auto solver = test::solver_for(s, crystal(n, n, 0.01, 0.01));
        const double dt = 0.05;
        for (int k = 0; k < 800; ++k) {
            const Box box = solver->view(Need::base).box;
            const double rate = 2e-3;
            solver->advance(WallMotion{box, {0.0, -rate * box.width(), 0.0, -rate * box.height()}}, dt);
        }
        return solver;
    };
    const auto one = compressed(4), four = compressed(8);
    const Mat2 a = one->cell_stress(), b = four->cell_stress();
    EXPECT_GT(a.trace(), 5e-2);
    EXPECT_NEAR((a - b).norm(), 0.0, 1e-9 * a.norm());
    const EnergyLedger e = one->view(Need::base).energy, f = four->view(Need::base).energy;
    EXPECT_NEAR(4.0 * e.elastic, f.elastic, 1e-9 * f.elastic);
    EXPECT_NEAR(4.0 * e.external_work, f.external_work, 1e-9 * f.external_work);
    EXPECT_LT(
        std::abs(test::residual(f, test::solver_for(test::default_scenario(0.3), crystal(8, 8, 0.01, 0.01))
                                       ->view(Need::base)
                                       .energy.elastic)),
        2e-3 * f.external_work);
}

TEST(Cell, ACrystalCarriedAlongStaysACrystal) {
    // Isotropic compression of a perfect lattice: grains keep their places in the cell, forces balance. Up to
    // an overlap of 1 %: from about 1.5 % on the law's own energy is lower for unequal contacts.
    auto solver = test::solver_for(test::undamped_scenario(), crystal(4, 4, 0.002));
    const double dt = 0.02;
    const std::vector<Vec2> start = crystal(4, 4, 0.002).center;
    const Box first = solver->view(Need::base).box;
    for (int k = 0; k < 1000; ++k) {
        const Box box = solver->view(Need::base).box;
        solver->advance(WallMotion{box, {0.0, -4e-4 * first.width(), 0.0, -4e-4 * first.height()}}, dt);
    }
    const GrainView v = solver->view(Need::base);
    const Mat2 map = v.box.lattice() * first.lattice().inverse();
    EXPECT_NEAR(map(0, 0), 0.992, 1e-12);
    for (std::size_t g = 0; g < v.size(); ++g)
        EXPECT_NEAR((v.centroid[g] - map * start[g]).norm(), 0.0, 1e-9) << g;
    const Mat2 stress = solver->cell_stress();
    EXPECT_NEAR(stress(0, 0), stress(1, 1), 1e-9);  // a hexagonal lattice is isotropic
    EXPECT_NEAR(stress(0, 1), 0.0, 1e-12);
    // Kinetic energy is that of the F alone: motion along with the cell does not count.
    EXPECT_LT(v.energy.kinetic, 1e-3);
}

TEST(Cell, TheSameLatticeByOtherVectorsGivesTheSameForces) {
    // The second lattice vector, plus or minus the first, spans the same lattice.
    Packing packing = crystal(4, 4, 0.06, 0.01);
    packing.box.tilt = 0.45 * packing.box.width();
    for (Vec2& c : packing.center) c.x() += packing.box.shear_strain() * c.y();
    const auto solver = test::solver_for(test::undamped_scenario(), packing);
    const GrainView v = solver->view(Need::contacts);
    ASSERT_GE(v.contacts.size(), 32U);
    for (int flips : {-2, 1, 3}) {
        Packing other = packing;
        other.box = packing.box.flipped(flips);
        const auto flipped = test::solver_for(test::undamped_scenario(), other);
        const GrainView w = flipped->view(Need::contacts);
        ASSERT_EQ(w.contacts.size(), v.contacts.size());
        for (std::size_t k = 0; k < v.contacts.size(); ++k) {
            EXPECT_EQ(w.contacts[k].j, v.contacts[k].j);
            EXPECT_NEAR((w.contacts[k].force - v.contacts[k].force).norm(), 0.0, 1e-13);
        }
        EXPECT_NEAR((flipped->cell_stress() - solver->cell_stress()).norm(), 0.0, 1e-14);
        EXPECT_NEAR(w.energy.elastic, v.energy.elastic, 1e-14);
    }
}

std::int64_t flips_of(const Solver& solver) {
    Checkpoint c;
    solver.save(c);
    return c.integers.at("sdem.counters").at(1);
}

TEST(Cell, ShearByMoreThanACellIsSmooth) {
    Scenario s = test::default_scenario(0.3);
    const Packing packing = crystal(4, 4, 0.02, 0.01);
    auto solver = test::solver_for(s, packing);
    const test::Bodies bodies(*solver, packing);
    const double start_energy = solver->view(Need::base).energy.elastic, dt = 0.05, rate = 0.01;
    double at_flip = 0.0, elsewhere = 0.0;
    std::int64_t flips = 0;
    Mat2 before = solver->cell_stress();
    for (int k = 0; k < 3200; ++k) {
        WallMotion motion{solver->view(Need::base).box, {}};
        motion.tilt_rate = rate * motion.box.height();
        solver->advance(motion, dt);
        const Mat2 now = solver->cell_stress();
        const bool flipped = flips_of(*solver) != flips;
        flips = flips_of(*solver);
        double& jump = flipped ? at_flip : elsewhere;
        if (k > 0) jump = std::max(jump, (now - before).norm());
        before = now;
    }
    const Box box = solver->view(Need::base).box;
    EXPECT_GT(box.tilt, 1.3 * box.width());  // the view's tilt is not reduced
    EXPECT_GE(flips, 1);
    EXPECT_GT(at_flip, 0.0);
    EXPECT_LT(at_flip, elsewhere);
    const EnergyLedger e = solver->view(Need::base).energy;
    EXPECT_GT(e.external_work, 0.0);
    EXPECT_GT(e.damping, 0.0);
    RecordProperty("residual", fmt::format("{:.1e}", test::residual(e, start_energy) / e.external_work));
    EXPECT_LT(std::abs(test::residual(e, start_energy)), 1e-2 * e.external_work);
    EXPECT_NEAR(test::momentum_of(*solver, bodies).linear.y(), 0.0, 1e-12);
    for (const Vec2& c : solver->view(Need::base).centroid) {
        EXPECT_LT(std::abs(c.y() - 0.5 * box.height()), 0.5 * box.height() + 0.3);
        EXPECT_LT(std::abs(c.x()), 3.0 * box.width());
    }
}

TEST(Cell, ALoneGrainFollowsTheFlowWithoutForce) {
    // A grain without contacts that starts with the flow stays at its place in the deforming cell.
    Packing p = crystal(4, 4, -0.2);
    auto solver = test::solver_for(test::undamped_scenario(), p);
    WallMotion motion{p.box, {0.0, 0.04, 0.0, -0.03}};
    motion.tilt_rate = 0.1;
    for (int k = 0; k < 100; ++k) {
        motion.box = solver->view(Need::base).box;
        solver->advance(motion, 0.05);
    }
    const GrainView v = solver->view(Need::contacts);
    EXPECT_TRUE(v.contacts.empty());
    const Mat2 to_cell = v.box.lattice().inverse(), at_first = p.box.lattice().inverse();
    for (std::size_t g = 0; g < p.size(); ++g) {
        const Vec2 place = to_cell * (v.centroid[g] - v.box.origin()),
                   first = at_first * (p.center[g] - p.box.origin());
        const Vec2 shift = place - first;
        EXPECT_NEAR((shift - Vec2{std::round(shift.x()), std::round(shift.y())}).norm(), 0.0, 1e-12) << g;
    }
    EXPECT_NEAR(v.energy.kinetic, 0.0, 1e-20);
    EXPECT_NEAR(v.energy.external_work, 0.0, 1e-20);
}

}  // namespace
}  // namespace softgrain::sdem
