// What every method with a periodic cell must keep: nothing depends on where the edges of the cell are drawn.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "common/observables/stress.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/jammed_cell.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain {
namespace {

using namespace testing;

std::vector<Bands> with_cell(bool has_one) {
    std::vector<Bands> some;
    for (const Bands& bands : all_bands())
        if ((bands.cell > 0.0) == has_one) some.push_back(bands);
    return some;
}

class CellContract : public ::testing::TestWithParam<Bands> {
  protected:
    std::unique_ptr<Solver> solver_for(const Packing& packing) const {
        return make(GetParam(), scenario_of(GetParam().method), packing);
    }
    double slow(const Solver& solver) const {
        return GetParam().loading_time / std::sqrt(solver.stress_scale());
    }
    /// Mean stress tensors while the cell is compressed, then sheared.
    std::vector<Mat2> stresses(const Packing& packing) const {
        const auto solver = solver_for(packing);
        std::vector<Mat2> all;
        Mat2 impulse = Mat2::Zero();
        const auto add = [&](const Box&, double dt) { impulse += solver->cell_stress() * dt; };
        Box box = packing.box;
        for (const double shear : {0.0, 0.02, 0.02}) {
            const double time = 0.2 * slow(*solver);
            box = deform(*solver, box, shear == 0.0 ? 0.02 : 0.0, shear, time, add);
            all.emplace_back(impulse / time);
            impulse.setZero();
        }
        return all;
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, CellContract, ::testing::ValuesIn(with_cell(true)),
                         [](const auto& instance) { return instance.param.method; });

TEST_P(CellContract, TheEdgesDoNotMatter) {
    const Packing packing = jammed_cell(30);
    const auto here = stresses(packing);
    ASSERT_GT(here.back().trace(), 0.0);
    Packing moved = packing;
    for (Vec2& c : moved.center) c = moved.box.wrapped(c + Vec2{3.3, 5.1});
    Packing flipped = packing;
    flipped.box.tilt = 2.0 * flipped.box.width();
    double largest = 0.0;
    for (const Packing& other : {moved, flipped}) {
        const auto there = stresses(other);
        for (std::size_t k = 0; k < here.size(); ++k) {
            const double difference = (there[k] - here[k]).norm() / here.back().norm();
            EXPECT_LE(difference, GetParam().cell) << "part " << k;
            largest = std::max(largest, difference);
        }
    }
    RecordProperty("largest_difference", fmt::format("{:.1e}", largest));
}

TEST_P(CellContract, TheStressIsThatOfTheContactsSeen) {
    const Packing packing = jammed_cell(30);
    const auto solver = solver_for(packing);
    deform(*solver, packing.box, 0.02, 0.02, 0.2 * slow(*solver));
    const GrainView view = solver->view(Need::all);
    EXPECT_GT(solver->cell_stress().trace(), 0.0) << "compression is positive";
    EXPECT_LE((love_weber_stress(view) - solver->cell_stress()).norm(), 1e-9 * solver->cell_stress().norm());
    EXPECT_LE(view.covered_area, view.box.area());
    for (const GrainContact& c : view.contacts) {
        ASSERT_FALSE(c.with_wall());
        const Vec2 from_i = c.point - view.centroid[static_cast<std::size_t>(c.i)];
        EXPECT_LT(from_i.norm(), branch(view, c).norm()) << "the point lies near grain i";
        EXPECT_GT(c.normal.dot(branch(view, c)), 0.0);
    }
    for (const Vec2& f : view.wall_force) EXPECT_EQ(f.norm(), 0.0) << "there are no walls";
}

TEST_P(CellContract, TheEnergyLedgerCloses) {
    const Packing packing = jammed_cell(30);
    const auto solver = solver_for(packing);
    const EnergyLedger before = solver->view(Need::base).energy;
    const Box box = deform(*solver, packing.box, 0.02, 0.0, 0.3 * slow(*solver));
    deform(*solver, box, 0.0, 0.05, 0.5 * slow(*solver));
    const EnergyLedger after = solver->view(Need::base).energy;
    const double residual = after.external_work + before.kinetic + before.elastic - after.kinetic -
                            after.elastic - after.dissipated();
    ASSERT_GT(after.external_work, 0.0);
    EXPECT_LE(std::abs(residual), std::max(GetParam().ledger, 1e-6) * after.external_work);
}

TEST_P(CellContract, ARestartedRunHasTheSameBits) {
    const Packing packing = jammed_cell(30);
    const auto run = [&](double shear) {
        return [=, this](Solver& solver, const Box& box) {
            return deform(solver, box, 0.01, shear, 0.1 * slow(solver));
        };
    };
    // Far enough that the tilt has been reduced.
    expect_restart_keeps_bits([&] { return solver_for(packing); },
                              [&](Solver& solver) { return run(0.7)(solver, packing.box); }, run(-0.1));
}

TEST_P(CellContract, TwoThreadsGiveTheBitsOfOne) {
    Packing packing = square_lattice(36);
    packing.box.periodic = true;
    expect_threads_keep_bits([&] { return solver_for(packing); }, {1, 2},
                             [&](Solver& solver) {
                                 deform(solver, packing.box, 0.02, 0.01, 30.0 * solver.stable_time_step());
                                 solver.view(Need::all);
                             });
}

/// Uses of one feature each, of which bpm has none.
TEST(Refusal, OfWhatAggregatesDoNotHave) {
    const Method& bpm = find_method("bpm");
    const Packing packing = four_grains();
    Packing periodic = packing, ellipses = packing;
    periodic.box.periodic = true;
    ellipses.aspect_ratio = {1.0, 2.0, 1.0, 1.0};
    ellipses.angle = {0.0, 0.0, 0.0, 0.0};
    EXPECT_THROW(bpm.make(scenario_of("bpm"), periodic), InputError);
    EXPECT_THROW(bpm.make(scenario_of("bpm"), ellipses), InputError);
    for (const char* extra : {"[material]\nwall_friction = 0.1\n", "[material]\ncohesion = 0.1\n",
                              "[material]\nyield_stress = 0.1\n", "[[grain_class]]\n[[grain_class]]\n"})
        EXPECT_THROW(bpm.make(scenario_of("bpm", extra), packing), InputError) << extra;
}

}  // namespace
}  // namespace softgrain
