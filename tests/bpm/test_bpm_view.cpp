#include <gtest/gtest.h>

#include <numbers>

#include "bpm/outline.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

TEST(BpmView, AreasAtTheStartAreThoseOfThePacking) {
    const Packing packing = square_packing(3, 2, 0.4);
    BpmSolver solver(scenario_of(60), packing);
    const GrainView view = solver.view(Need::area);
    double sum = 0.0;
    for (double area : view.area) sum += area;
    const double expected = 6.0 * std::numbers::pi;
    EXPECT_NEAR(sum / expected, 1.0, 0.01);  // rho is in units of the sample's mean disc
    EXPECT_NEAR(view.covered_area / expected, 1.0, 0.01);
    for (std::size_t g = 0; g < 6; ++g) {
        EXPECT_DOUBLE_EQ(view.reference_area[g], std::numbers::pi);
        EXPECT_NEAR(view.mass[g], std::numbers::pi, 1e-12);
        EXPECT_NEAR((view.centroid[g] - packing.center[g]).norm(), 0.0, 0.02);
    }
}

/// No grain is placed with a disc behind one of another grain, where it would be torn off later.
TEST(BpmView, GrainsArePlacedWhole) {
    const Packing packing = square_packing(5, 5, 0.0);
    const BpmSolver solver(scenario_of(250, 2), packing);
    const auto x = solver.disc_position();
    const auto radius = solver.disc_radius();
    double worst = 0.0;
    for (std::size_t g = 0; g < packing.size(); ++g)
        for (int i = solver.grain_start()[g]; i < solver.grain_start()[g + 1]; ++i) {
            double nearest = 1e9;
            for (int j = solver.grain_start()[g]; j < solver.grain_start()[g + 1]; ++j) {
                const auto a = static_cast<std::size_t>(i), b = static_cast<std::size_t>(j);
                if (i != j) nearest = std::min(nearest, (x[b] - x[a]).norm() - radius[a] - radius[b]);
            }
            worst = std::max(worst, nearest / solver.mean_disc_diameter());
        }
    EXPECT_LT(worst, 0.02);
}

TEST(BpmView, FrameTurnsAndMirrorsTheGrain) {
    Packing packing = square_packing(1, 1, 1.0);
    const BpmSolver plain(scenario_of(30), packing);
    Mat2 mirror;
    mirror << 0.6, 0.8, 0.8, -0.6;
    packing.frame = {mirror};
    const BpmSolver turned(scenario_of(30), packing);
    // Both come to rest from equal states: they differ by the contact tolerance only.
    for (std::size_t d = 0; d < 30; ++d) {
        const Vec2 expected = packing.center[0] + mirror * (plain.disc_position()[d] - packing.center[0]);
        EXPECT_LT((turned.disc_position()[d] - expected).norm(), 0.01 * plain.mean_disc_diameter());
    }
}

TEST(BpmView, ContactsAreSortedAndPushApart) {
    Pressed sample;
    const GrainView view = sample.solver.view(Need::contacts);
    ASSERT_GE(view.contacts.size(), 10U);  // of 4 between grains and 8 with walls
    for (std::size_t k = 0; k < view.contacts.size(); ++k) {
        const GrainContact& c = view.contacts[k];
        EXPECT_NEAR(c.normal.norm(), 1.0, 1e-12);
        EXPECT_GE(c.normal_force(), 0.0);
        EXPECT_GT(c.length, 0.5 * sample.solver.mean_disc_diameter());
        const Vec2 outward = c.point - view.centroid[static_cast<std::size_t>(c.i)];
        EXPECT_GT(outward.dot(c.normal), 0.0);
        if (k == 0) continue;
        const GrainContact& last = view.contacts[k - 1];
        EXPECT_TRUE(last.i < c.i || (last.i == c.i && last.j < c.j));
    }
}

TEST(BpmView, WallContactsAddUpToTheWallForce) {
    Pressed sample;
    const GrainView view = sample.solver.view(Need::contacts);
    std::array<Vec2, 4> sum{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    for (const GrainContact& c : view.contacts)
        if (c.with_wall()) sum[static_cast<std::size_t>(c.wall())] -= c.force;
    for (std::size_t w = 0; w < 4; ++w) {
        EXPECT_LT((sum[w] - view.wall_force[w]).norm(), 1e-12);
        EXPECT_GT(-view.wall_force[w].dot(wall_normal(static_cast<int>(w))), 0.02);
    }
}

TEST(BpmView, LoveWeberStressAgreesWithTheWalls) {
    Pressed sample;
    // At rest: mean stress of the sample from the grains and from the walls, averaged over fluctuations.
    double from_grains = 0.0, from_walls = 0.0;
    const double h = sample.solver.stable_time_step();
    for (int k = 0; k < 200; ++k) {
        sample.press(0.0, h);
        const GrainView view = sample.solver.view(Need::stress);
        for (std::size_t g = 0; g < view.size(); ++g)
            from_grains += view.reference_area[g] * view.stress[g](0, 0) / sample.box.area();
        from_walls += 0.5 * (view.wall_force[1].x() - view.wall_force[0].x()) / sample.box.height();
    }
    EXPECT_GT(from_walls / 200, 0.02);
    EXPECT_NEAR(from_grains / from_walls, 1.0, 0.05);
}

TEST(BpmView, CoveredAreaCountsOverlapsOnce) {
    Pressed sample;
    const GrainView view = sample.solver.view(Need::area);
    double sum = 0.0;
    for (double area : view.area) sum += area;
    EXPECT_LT(view.covered_area, sample.box.area());
    // The closing of the whole also fills the narrow pores between grains.
    EXPECT_GT(view.covered_area, 0.98 * sum);
    EXPECT_LT(view.covered_area, 1.05 * sum);
}

TEST(BpmView, OutlinesAreCounterClockwiseAndHoldTheArea) {
    Pressed sample;
    const GrainView view = sample.solver.view(Need::outlines | Need::area);
    ASSERT_EQ(view.outline_offset.size(), 5U);
    for (std::size_t g = 0; g < 4; ++g) {
        const auto first = static_cast<std::size_t>(view.outline_offset[g]);
        const auto last = static_cast<std::size_t>(view.outline_offset[g + 1]);
        const double area = polygon_area(view.outline_point.subspan(first, last - first));
        // Only the polygon counts pores that rho enters; one of a disc's size is 1.4 % of a grain of 60.
        EXPECT_NEAR(area / view.area[g], 1.0, 0.02);
        for (std::size_t k = first; k < last; ++k)
            for (int wall = 0; wall < 4; ++wall)
                EXPECT_GT(sample.box.distance(wall, view.outline_point[k]),
                          -1e-3 * sample.solver.mean_disc_diameter());
    }
}

TEST(BpmView, FieldsHaveOneValueForEachGrain) {
    Pressed sample;
    const GrainView view = sample.solver.view(Need::fields);
    ASSERT_EQ(view.fields.size(), 6U);
    for (const Field& field : view.fields)
        EXPECT_EQ(field.values.size(), 4U * static_cast<std::size_t>(field.components)) << field.name;
    EXPECT_EQ(view.fields[0].values[0], 60.0);
    EXPECT_EQ(view.fragments, 4.0);
    for (double deepest : view.fields[1].values) {
        EXPECT_GE(deepest, 0.0);
        EXPECT_LT(deepest, 1e-3);
    }
}

TEST(BpmView, NothingIsComputedUnasked) {
    BpmSolver solver(scenario_of(20), square_packing(1, 1, 0.5));
    const GrainView view = solver.view(Need::base);
    EXPECT_TRUE(view.area.empty());
    EXPECT_TRUE(view.contacts.empty());
    EXPECT_TRUE(view.outline_point.empty());
    EXPECT_TRUE(view.fields.empty());
    EXPECT_EQ(view.covered_area, 0.0);
    EXPECT_EQ(solver.view(Need::all).parts.size(), 0U);
    EXPECT_EQ(view.size(), 1U);
}

}  // namespace
}  // namespace softgrain::bpm
