// Rigid DEM in a periodic cell: nothing may depend on where the cell's edges lie.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "common/errors.hpp"
#include "common/observables/stress.hpp"
#include "rigid_dem/method.hpp"
#include "rigid_dem/solver.hpp"
#include "tests/support/jammed_cell.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain::rigid_dem {
namespace {

Scenario scenario_with(double friction) {
    Scenario s;
    s.material.friction = friction;
    Settings table(method().keys());
    table.set("restitution", 0.5);
    table.set("overlap_limit", 10.0);
    s.method_settings["rigid_dem"] = table;
    return s;
}

/// The cell moves by these rates [1/s] of its size for a time.
struct Rates {
    double width, height, shear;
};

Box deform(
    RigidDem& dem, Box box, const Rates& rates, double time,
    const std::function<void(const WallMotion&, double)>& after_step = [](const WallMotion&, double) {}) {
    const double dt_most = dem.stable_time_step();
    const int steps = static_cast<int>(std::ceil(time / dt_most));
    const double w = box.width() * rates.width, h = box.height() * rates.height;
    const double tilt = box.height() * rates.shear + box.tilt * rates.width;
    for (int k = 0; k < steps; ++k) {
        const WallMotion motion{box, {-0.5 * w, 0.5 * w, -0.5 * h, 0.5 * h}, tilt};
        dem.advance(motion, time / steps);
        box = motion.after(time / steps);
        after_step({box, motion.velocity, motion.tilt_rate}, time / steps);
    }
    return box;
}

/// Two discs meet in the middle of the cell, or across its corner.
TEST(RigidDemCell, ACollisionAcrossTheEdgeIsAnyCollision) {
    Packing p;
    p.box = Box{{0.0, 8.0, 0.0, 6.0}, true, 1.0};
    p.radius = {1.0, 0.9};
    const auto outcome = [&](const Vec2& middle) {
        p.center = {middle - Vec2{0.7, 0.75}, middle + Vec2{0.7, 0.75}};
        RigidDem dem(scenario_with(0.1), p);
        dem.set_velocity(std::vector<Vec2>{{0.03, 0.0}, {0.0, 0.0}}, std::vector<double>{0.01, 0.0});
        deform(dem, p.box, {0.0, 0.0, 0.0}, 60.0);
        const GrainView view = dem.view(Need::base);
        EXPECT_GT(view.energy.friction, 0.0);
        return std::vector<double>{view.velocity[0].x(), view.velocity[0].y(), view.velocity[1].x(),
                                   view.velocity[1].y(), dem.spin()[0],        dem.spin()[1]};
    };
    const auto inside = outcome({4.5, 3.0});
    for (const Vec2& edge : {Vec2{0.0, 3.0}, Vec2{1.0, 6.0}, Vec2{0.0, 0.0}, Vec2{16.5, -9.0}}) {
        const auto across = outcome(edge);
        for (std::size_t k = 0; k < inside.size(); ++k)
            EXPECT_NEAR(across[k], inside[k], 1e-13) << "middle at " << edge.transpose();
    }
}

/// A lone grain in a deforming cell follows the flow: wrapped or not it feels no force and has no energy.
TEST(RigidDemCell, AFreeGrainFollowsTheFlowWithoutForce) {
    Packing p;
    p.box = Box{{-3.0, 7.0, 0.0, 8.0}, true, 2.0};
    p.center = {{6.9, 7.8}, {1.0, 1.0}};
    p.radius = {0.5, 0.4};
    RigidDem dem(scenario_with(0.0), p);
    const Mat2 inverse = p.box.lattice().inverse();
    const Vec2 before[2]{inverse * (p.center[0] - p.box.origin()), inverse * (p.center[1] - p.box.origin())};
    Box box = deform(dem, p.box, {-0.002, 0.001, 0.05}, 40.0);
    box = deform(dem, box, {0.001, -0.003, -0.02}, 40.0);
    const GrainView view = dem.view(Need::base);
    EXPECT_LT(view.energy.kinetic, 1e-25);
    EXPECT_NEAR(view.energy.external_work, 0.0, 1e-25);
    for (std::size_t g = 0; g < 2; ++g) {
        const Vec2 there = box.origin() + box.lattice() * before[g];
        EXPECT_NEAR(box.nearest(view.centroid[g] - there).norm(), 0.0, 1e-11);
    }
}

struct Path {
    std::vector<double> stress;
    double external_work = 0.0, residual = 0.0, kinetic = 0.0;
};

/// Compression and then shear of a jammed cell.
Path path_of(const Packing& packing, double friction) {
    RigidDem dem(scenario_with(friction), packing);
    const EnergyLedger start = dem.view(Need::base).energy;
    Path path;
    Mat2 sum = Mat2::Zero();
    int steps = 0;
    const auto record = [&](const WallMotion&, double) {
        sum += dem.cell_stress();
        if (++steps % 200 != 0) return;
        for (int k = 0; k < 4; ++k) path.stress.push_back(sum(k / 2, k % 2) / 200.0);
        sum.setZero();
    };
    Box box = deform(dem, packing.box, {-1e-4, -1e-4, 0.0}, 200.0, record);
    box = deform(dem, box, {0.0, 0.0, 1e-4}, 600.0, record);
    const EnergyLedger end = dem.view(Need::base).energy;
    path.external_work = end.external_work;
    path.kinetic = end.kinetic;
    path.residual =
        end.external_work + start.kinetic + start.elastic - end.kinetic - end.elastic - end.dissipated();
    return path;
}

TEST(RigidDemCell, TheEdgesOfTheCellDoNotMatter) {
    const Packing packing = testing::jammed_cell(40);
    const Path here = path_of(packing, 0.0);
    ASSERT_GE(here.stress.size(), 12U);
    double scale = 0.0;
    for (const double s : here.stress) scale = std::max(scale, std::abs(s));
    ASSERT_GT(scale, 1e-3);
    Packing moved = packing;
    for (Vec2& c : moved.center) c = moved.box.wrapped(c + Vec2{3.3, 5.1});
    Packing flipped = packing;  // the same lattice by another second vector
    flipped.box.tilt = 3.0 * flipped.box.width();
    for (const Packing& other : {moved, flipped}) {
        const Path there = path_of(other, 0.0);
        ASSERT_EQ(there.stress.size(), here.stress.size());
        // Rearrangements amplify rounding; none of them does so by more than 1e5 here.
        for (std::size_t k = 0; k < here.stress.size(); ++k)
            EXPECT_NEAR(there.stress[k], here.stress[k], 1e-9 * scale) << "number " << k;
    }
}

TEST(RigidDemCell, TheEnergyLedgerClosesAndShearResists) {
    for (const double friction : {0.0, 0.4}) {
        const Path path = path_of(testing::jammed_cell(40), friction);
        EXPECT_GT(path.external_work, 0.0);
        EXPECT_LT(std::abs(path.residual), 0.01 * path.external_work) << "friction " << friction;
        const std::size_t last = path.stress.size() - 4;
        EXPECT_GT(path.stress[last], 1e-4) << "xx is compression";
        EXPECT_GT(path.stress[last + 3], 1e-4);
        EXPECT_LT(path.stress[last + 1], 0.0) << "forces oppose a positive shear";
    }
}

TEST(RigidDemCell, CellStressIsLoveWeberAndTheViewIsConsistent) {
    const Packing packing = testing::jammed_cell(40);
    RigidDem dem(scenario_with(0.3), packing);
    const Box box = deform(dem, packing.box, {-1e-4, -1e-4, 2e-4}, 200.0);
    const GrainView view = dem.view(Need::all);
    EXPECT_EQ(view.box.tilt, box.tilt);
    EXPECT_NEAR((love_weber_stress(view) - dem.cell_stress()).norm(), 0.0, 1e-14);
    ASSERT_GT(view.contacts.size(), 60U);
    std::vector<Mat2> stress(view.size(), Mat2::Zero());
    for (const GrainContact& c : view.contacts) {
        ASSERT_FALSE(c.with_wall());
        const auto i = static_cast<std::size_t>(c.i);
        EXPECT_NEAR((branch(view, c).normalized() - c.normal).norm(), 0.0, 1e-12);
        EXPECT_LT((c.point - view.centroid[i]).norm(), packing.radius[i]) << "the point is near grain i";
    }
    Mat2 sum = Mat2::Zero();
    for (std::size_t g = 0; g < view.size(); ++g) sum += view.stress[g] * view.reference_area[g];
    EXPECT_NEAR((sum / box.area() - dem.cell_stress()).norm(), 0.0, 1e-13) << "grain stresses add up";
}

TEST(RigidDemCell, ARestartHasTheSameBits) {
    const Packing packing = testing::jammed_cell(40);
    testing::expect_restart_keeps_bits(
        [&] { return std::make_unique<RigidDem>(scenario_with(0.3), packing); },
        [&](RigidDem& dem) {
            const Box box = deform(dem, packing.box, {-1e-4, -1e-4, 6e-3}, 150.0);
            EXPECT_GT(box.flips(), 0);
            return box;
        },
        [](RigidDem& dem, const Box& box) {
            deform(dem, box, {-1e-4, 0.0, -2e-3}, 150.0);
        });
}

/// Springs in series and masses of two materials: frequency of a pair, and who is pushed how far.
TEST(RigidDem, ClassesHaveTheirOwnStiffnessAndMass) {
    Scenario s = scenario_with(0.0);
    s.method_settings["rigid_dem"].set("restitution", 1.0);
    s.classes.resize(2);
    s.classes[1].material.youngs_modulus = 3.0;
    s.classes[1].material.density = 2.0;
    Packing p;
    p.box.position = {-100.0, 100.0, -100.0, 100.0};
    p.center = {{-1.0, 0.0}, {1.0, 0.0}};
    p.radius = {1.0, 1.0};
    p.grain_class = {0, 1};
    RigidDem dem(s, p);
    EXPECT_EQ(dem.stress_scale(), 2.0) << "the mean of 1 and 3";
    dem.set_velocity(std::vector<Vec2>{{2e-3, 0.0}, {-1e-3, 0.0}}, std::vector<double>{0.0, 0.0});
    const double k = 0.75, m1 = std::acos(-1.0), m2 = 2.0 * m1;
    const double omega = std::sqrt(k / (m1 * m2 / (m1 + m2)));
    const int steps = 1000;
    const double dt = 0.5 * std::acos(-1.0) / omega / steps;
    for (int step = 0; step < steps; ++step) dem.advance({p.box, {}, 0.0}, dt);
    const GrainView view = dem.view(Need::base);
    EXPECT_NEAR(2.0 - (view.centroid[1] - view.centroid[0]).norm(), 3e-3 / omega, 1e-8);
    EXPECT_NEAR(view.mass[1], m2, 1e-14);
    // The centre of mass was at rest.
    EXPECT_NEAR(m1 * view.velocity[0].x() + m2 * view.velocity[1].x(), 0.0, 1e-15);
}

TEST(RigidDem, RefusesWhatItDoesNotHave) {
    Packing p;
    p.box.position = {0.0, 4.0, 0.0, 4.0};
    p.center = {{2.0, 2.0}};
    p.radius = {1.0};
    const auto refused = [&](const std::function<void(Scenario&, Packing&)>& change) {
        Scenario s = scenario_with(0.0);
        Packing packing = p;
        change(s, packing);
        EXPECT_THROW(method().make(s, packing), InputError);
    };
    EXPECT_NO_THROW(method().make(scenario_with(0.0), p));
    refused([](Scenario& s, Packing&) {
        s.material.cohesion = 0.1;
        s.method_settings.at("rigid_dem").set("normal_law", std::string("hertz"));
    });
    refused([](Scenario& s, Packing&) { s.material.yield_stress = 0.1; });
    refused([](Scenario&, Packing& packing) {
        packing.aspect_ratio = {1.1};
        packing.angle = {0.0};
    });
}

}  // namespace
}  // namespace softgrain::rigid_dem
