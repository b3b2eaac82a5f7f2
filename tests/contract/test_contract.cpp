// What every method must keep, whatever its model of a grain.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "common/errors.hpp"
#include "common/observables/stress.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain {
namespace {

using namespace testing;

class Contract : public ::testing::TestWithParam<Bands> {
  protected:
    std::unique_ptr<Solver> solver_for(const Packing& packing) const {
        return make(GetParam(), scenario_of(GetParam().method), packing);
    }
    /// Time that a squeeze takes when it is quasi-static for this material.
    double slow(const Solver& solver) const {
        return GetParam().loading_time / std::sqrt(solver.stress_scale());
    }
};

INSTANTIATE_TEST_SUITE_P(Methods, Contract, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST(ContractTable, HasABandForEveryMethod) {
    ASSERT_EQ(all_bands().size(), methods().size());
    for (std::size_t m = 0; m < methods().size(); ++m) EXPECT_EQ(all_bands()[m].method, methods()[m].name);
}

TEST_P(Contract, NoMotionWhereThereIsNoForce) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    const GrainView start = solver->view(Need::base);
    const std::vector<Vec2> placed(start.centroid.begin(), start.centroid.end());
    squeeze(*solver, packing.box, 0.0, 0.2 * slow(*solver));
    const GrainView view = solver->view(Need::base);
    for (std::size_t g = 0; g < packing.size(); ++g) {
        EXPECT_LE((placed[g] - packing.center[g]).norm(), GetParam().placing) << "grain " << g;
        EXPECT_LE((view.centroid[g] - placed[g]).norm(), GetParam().at_rest) << "grain " << g;
    }
}

/// The walls' impulse is all that changes the momentum of the grains.
TEST_P(Contract, MomentumComesFromTheWalls) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    const auto total_force = [&] {
        Vec2 force = Vec2::Zero();
        for (const Vec2& f : solver->wall_force()) force -= f;
        return force;
    };
    Vec2 before = total_force();
    Vec2 implicit = Vec2::Zero();   // impulses of the step itself (contact dynamics)
    Vec2 explicit_ = Vec2::Zero();  // forces at the start of each step (leap-frog)
    Vec2 centred = Vec2::Zero();    // the same over half of the step before and half of this one
    double step_before = 0.0;       // and the mean of the first two is a kick at either end
    double largest = 0.0;
    double error = 0.0;
    push(*solver, packing.box, Wall::left, 0.08, 0.05 * slow(*solver), [&](const Box&, double dt) {
        explicit_ += before * dt;
        centred += before * 0.5 * (step_before + dt);
        step_before = dt;
        before = total_force();
        implicit += before * dt;
        const GrainView view = solver->view(Need::base);
        Vec2 momentum = Vec2::Zero();
        for (std::size_t g = 0; g < view.size(); ++g) momentum += view.mass[g] * view.velocity[g];
        largest = std::max(largest, momentum.norm());
        error = std::max(
            error, std::min({(momentum - implicit).norm(), (momentum - explicit_).norm(),
                             (momentum - centred).norm(), (momentum - 0.5 * (explicit_ + implicit)).norm()}));
    });
    ASSERT_GT(largest, 0.0);
    EXPECT_LE(error, 1e-10 * largest);
}

TEST_P(Contract, WallReactionAgreesWithLoveWeberAtRest) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    Box box = squeeze(*solver, packing.box, 0.12, slow(*solver));
    box = squeeze(*solver, box, 0.0, slow(*solver));
    // Mean over a while: aggregates tremble by their contact solver's tolerance.
    Mat2 inside = Mat2::Zero();
    Vec2 walls = Vec2::Zero();
    int samples = 0;
    squeeze(*solver, box, 0.0, 0.1 * slow(*solver), [&](const Box&, double) {
        const GrainView view = solver->view(Need::contacts);
        inside += love_weber_stress(view);
        walls += wall_stress(view.wall_force, view.box);
        ++samples;
    });
    inside /= samples;
    walls /= samples;
    const double scale = 0.5 * walls.sum();
    ASSERT_GT(scale, 1e-3 * solver->stress_scale()) << "the scene must be loaded to test anything";
    EXPECT_NEAR(inside(0, 0), walls.x(), GetParam().equilibrium * scale);
    EXPECT_NEAR(inside(1, 1), walls.y(), GetParam().equilibrium * scale);
    EXPECT_NEAR(inside(0, 1), inside(1, 0), GetParam().equilibrium * scale) << "torques balance";
}

TEST_P(Contract, ARotatedOrMirroredSceneGivesTheRotatedOrMirroredAnswer) {
    const Packing packing = four_grains();
    Mat2 quarter_turn, mirror;
    quarter_turn << 0.0, -1.0, 1.0, 0.0;
    mirror << -1.0, 0.0, 0.0, 1.0;
    const auto original = solver_for(packing);
    squeeze(*original, packing.box, 0.24, 0.05 * slow(*original));
    const GrainView seen = original->view(Need::contacts | Need::area);
    const double scale = wall_stress(seen.wall_force, seen.box).norm();
    ASSERT_GT(scale, 1e-3 * original->stress_scale());
    const Vec2 middle{2.45, 2.45};
    for (const Mat2& image : {quarter_turn, mirror}) {
        const Packing turned = image_of(packing, image);
        const auto other = solver_for(turned);
        squeeze(*other, turned.box, 0.24, 0.05 * slow(*other));
        const GrainView there = other->view(Need::contacts | Need::area);
        for (std::size_t g = 0; g < packing.size(); ++g)
            EXPECT_LE((there.centroid[g] - middle - image * (seen.centroid[g] - middle)).norm(),
                      GetParam().symmetry);
        const Mat2 here_stress = image * love_weber_stress(seen) * image.transpose();
        EXPECT_LE((love_weber_stress(there) - here_stress).norm(), GetParam().symmetry_of_stress * scale);
        EXPECT_NEAR(there.covered_area, seen.covered_area, GetParam().symmetry * seen.covered_area);
    }
}

TEST_P(Contract, ARestartedRunHasTheSameBits) {
    const Packing packing = nine_grains();
    const auto run = [&](double strain) {
        return [=, this](Solver& solver, const Box& box) {
            return squeeze(solver, box, strain, 0.1 * slow(solver));
        };
    };
    expect_restart_keeps_bits([&] { return solver_for(packing); },
                              [&](Solver& solver) { return run(0.08)(solver, packing.box); }, run(0.04));
}

TEST_P(Contract, LookingAtTheGrainsDoesNotChangeThem) {
    const Packing packing = nine_grains();
    const auto watched = solver_for(packing);
    const auto alone = solver_for(packing);
    const double time = 0.05 * slow(*watched);
    squeeze(*watched, packing.box, 0.1, time,
            [&](const Box&, double) { watched->view(Need::all | Need::parts); });
    squeeze(*alone, packing.box, 0.1, time);
    EXPECT_TRUE(same_bits(saved(*watched), saved(*alone)));
}

TEST_P(Contract, TwoThreadsGiveTheBitsOfOne) {
    const bool grains_have_parts = GetParam().method == "bpm" || GetParam().method == "mpm";
    const Packing packing = square_lattice(grains_have_parts ? 8 : 36);
    expect_threads_keep_bits([&] { return solver_for(packing); }, {1, 2},
                             [&](Solver& solver) {
                                 squeeze(solver, packing.box, 0.02,
                                         std::min(30.0 * solver.stable_time_step(), slow(solver)));
                                 solver.view(Need::all | Need::parts);
                             });
}

TEST_P(Contract, TheEnergyLedgerCloses) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    const EnergyLedger before = solver->view(Need::base).energy;
    Box box = squeeze(*solver, packing.box, 0.12, 0.5 * slow(*solver));
    squeeze(*solver, box, -0.04, 0.5 * slow(*solver));
    const EnergyLedger after = solver->view(Need::base).energy;
    const double residual = after.external_work + before.kinetic + before.elastic -
                            (after.kinetic + after.elastic + after.dissipated());
    ASSERT_GT(after.external_work, 0.0);
    RecordProperty("residual", fmt::format("{:.1e}", residual / after.external_work));
    EXPECT_LE(std::abs(residual), GetParam().ledger * after.external_work);
    EXPECT_GE(after.damping, 0.0);
    EXPECT_GE(after.friction, 0.0);
    EXPECT_GE(after.impact, 0.0);
}

TEST_P(Contract, TheViewIsConsistent) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    squeeze(*solver, packing.box, 0.12, 0.3 * slow(*solver));
    const GrainView view = solver->view(Need::all | Need::parts);
    const std::size_t n = packing.size();
    ASSERT_EQ(view.centroid.size(), n);
    ASSERT_EQ(view.velocity.size(), n);
    ASSERT_EQ(view.mass.size(), n);
    ASSERT_EQ(view.area.size(), n);
    ASSERT_EQ(view.stress.size(), n);
    ASSERT_EQ(view.outline_offset.size(), n + 1);
    ASSERT_EQ(static_cast<std::size_t>(view.outline_offset.back()), view.outline_point.size());

    std::array<Vec2, 4> on_wall{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    double force_scale = 0.0;
    for (std::size_t k = 0; k < view.contacts.size(); ++k) {
        const GrainContact& c = view.contacts[k];
        EXPECT_NEAR(c.normal.norm(), 1.0, 1e-12);
        EXPECT_TRUE(c.with_wall() || c.j > c.i);
        if (k > 0) {
            EXPECT_LT(std::pair(view.contacts[k - 1].i, view.contacts[k - 1].j), std::pair(c.i, c.j));
        }
        if (c.with_wall()) on_wall[static_cast<std::size_t>(c.wall())] -= c.force;
        force_scale = std::max(force_scale, c.force.norm());
    }
    ASSERT_GT(force_scale, 0.0);
    for (std::size_t w = 0; w < 4; ++w)
        EXPECT_LE((on_wall[w] - view.wall_force[w]).norm(), 1e-9 * force_scale);

    double area = 0.0;
    for (std::size_t g = 0; g < n; ++g) {
        area += view.area[g];
        EXPECT_NEAR(view.reference_area[g], M_PI * packing.radius[g] * packing.radius[g], 1e-12);
        EXPECT_GT(view.stress[g].trace(), 0.0) << "compression is positive";
        double polygon = 0.0;
        for (int p = view.outline_offset[g]; p < view.outline_offset[g + 1]; ++p) {
            const int next = p + 1 < view.outline_offset[g + 1] ? p + 1 : view.outline_offset[g];
            polygon += 0.5 * cross(view.outline_point[static_cast<std::size_t>(p)],
                                   view.outline_point[static_cast<std::size_t>(next)]);
        }
        EXPECT_GT(polygon, 0.9 * view.area[g]) << "outlines go counter-clockwise around the grain";
        EXPECT_LT(polygon, 1.1 * view.area[g]);
    }
    EXPECT_LE(view.covered_area, area * (1.0 + GetParam().closed_pores));
    EXPECT_LE(view.covered_area, view.box.area());
    EXPECT_GT(view.covered_area, 0.9 * area);
    for (const Field& field : view.fields) {
        EXPECT_EQ(field.values.size(), n * static_cast<std::size_t>(field.components)) << field.name;
        for (const double v : field.values) EXPECT_TRUE(std::isfinite(v)) << field.name;
    }
    const PartView& parts = view.parts;
    ASSERT_EQ(parts.radius.size(), parts.size());
    ASSERT_EQ(parts.grain.size(), parts.size());
    for (const int grain : parts.grain) EXPECT_TRUE(grain >= 0 && grain < static_cast<int>(n));
    for (const Field& field : parts.fields)
        EXPECT_EQ(field.values.size(), parts.size() * static_cast<std::size_t>(field.components))
            << field.name;
}

TEST_P(Contract, AnAbsurdStepIsNamedAndLeavesNothingHidden) {
    const Packing packing = nine_grains();
    const auto solver = solver_for(packing);
    Box box = squeeze(*solver, packing.box, 0.12, 0.3 * slow(*solver));
    try {
        for (int k = 0; k < 50; ++k) {
            const WallMotion motion{box, {1.0, 0.0, 0.0, 0.0}};
            solver->advance(motion, 1e3 * solver->stable_time_step());
            box = motion.after(1e-9);
            solver->check_finite();
        }
        FAIL() << "nothing was noticed";
    } catch (const DivergedError& error) {
        EXPECT_FALSE(error.quantity.empty());
        EXPECT_NE(std::string(error.what()).find("t = "), std::string::npos);
    }
}

TEST_P(Contract, ACheckpointOfAnotherPackingIsRefused) {
    const Packing packing = nine_grains();
    Packing fewer = packing;
    fewer.center.pop_back();
    fewer.radius.pop_back();
    EXPECT_THROW(solver_for(fewer)->load(saved(*solver_for(packing))), InputError);
    EXPECT_THROW(solver_for(packing)->load(Checkpoint{}), InputError);
}

}  // namespace
}  // namespace softgrain
