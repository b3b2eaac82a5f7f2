// Packings in a part of the box, and the driven discs behind them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/packing/fill_region.hpp"
#include "common/packing/make_packing.hpp"
#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

const Box box{{0.0, 20.0, 0.0, 14.0}};

double smallest_gap(const Packing& p) {
    double gap = 100.0;
    for (std::size_t i = 0; i < p.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            gap = std::min(gap, (p.center[i] - p.center[j]).norm() - p.radius[i] - p.radius[j]);
    return gap;
}

TEST(FillRegion, PutsEveryDiscIntoADiscAndUsesAllOfIt) {
    const std::vector<double> radii(80, 0.25);
    const PackingRegion region{.center = {9.0, 6.0}, .radius = 4.0};
    Random random(3);
    const Packing p = fill_region(radii, region, box, random);
    ASSERT_EQ(p.size(), 80U);
    EXPECT_GE(smallest_gap(p), 0.0);
    double mean2 = 0.0;
    for (const Vec2& c : p.center) {
        EXPECT_LE((c - region.center).norm(), 3.75 + 1e-12);
        mean2 += (c - region.center).squaredNorm() / 80.0;
    }
    // Evenly spread over radius a: a^2 / 2, deviation a^2 / sqrt(12 n) = 0.032 a^2.
    EXPECT_NEAR(mean2 / (3.75 * 3.75), 0.5, 0.1);
    EXPECT_EQ(p.box.position, box.position);
}

TEST(FillRegion, PutsEveryDiscIntoARectangle) {
    const std::vector<double> radii{0.5, 0.2, 0.4, 0.3, 0.5, 0.5, 0.2};
    const PackingRegion region{.center = {3.0, 10.0}, .radius = 0.0, .size = {4.0, 2.0}};
    Random random(3);
    const Packing p = fill_region(radii, region, box, random);
    EXPECT_EQ(p.radius, radii);
    EXPECT_GE(smallest_gap(p), 0.0);
    for (std::size_t g = 0; g < p.size(); ++g) {
        EXPECT_LE(std::abs(p.center[g].x() - 3.0), 2.0 - radii[g]);
        EXPECT_LE(std::abs(p.center[g].y() - 10.0), 1.0 - radii[g]);
    }
}

TEST(FillRegion, SaysThatThereIsNoRoom) {
    const PackingRegion region{.center = {9.0, 6.0}, .radius = 1.0};
    Random random(1);
    EXPECT_THROW(fill_region(std::vector<double>(1, 1.5), region, box, random), InputError);
}

const std::string head =
    "[packing]\ngenerator = \"random_sequential\"\ncount = 20\nsize_law = \"single\"\nradius_mean = 0.4\n"
    "region = \"disc\"\nregion_radius = 3\n[box]\nwidth = 10\nheight = 8\n";

TEST(DrivenGrains, StandBehindThePackingAndLeaveItsFractionAlone) {
    const std::string ring =
        "[[driven]]\ncenter_x = 5\ncenter_y = 4\nradius = 3.2\ndisc_radius = 0.2\nspin = 2\n";
    const std::string row =
        "[[driven]]\nkind = \"row\"\nfrom_x = 1\nfrom_y = 0.1\nto_x = 2\nto_y = 0.1\ndisc_radius = 0.1\n"
        "spacing = 0.8\nvelocity_x = 0.5\n";
    const Packing p = make_packing(parse(head + ring + row + std::string(stage)));
    // Ceil(2 pi 3.2 / 0.4) = 51 and ceil(1 / 0.16) + 1 = 8.
    ASSERT_EQ(p.driven.size(), 59U);
    EXPECT_EQ(p.free_size(), 20U);
    EXPECT_NEAR(p.packing_fraction_undeformed(), 20 * std::numbers::pi * 0.16 / 80.0, 1e-12);
    for (std::size_t d = 20; d < 71; ++d) EXPECT_NEAR((p.center[d] - Vec2(5.0, 4.0)).norm(), 3.2, 1e-12);
    EXPECT_NEAR((p.center[21] - p.center[20]).norm(), 6.4 * std::sin(std::numbers::pi / 51.0), 1e-12);
    EXPECT_NEAR(p.center[71].x(), 1.0, 1e-12);
    EXPECT_NEAR(p.center[78].x(), 2.0, 1e-12);
    // A quarter turn.
    const Vec2 turned = p.driven[0].position(p.center[20], std::numbers::pi / 4.0);
    EXPECT_LE((turned - Vec2(5.0, 7.2)).norm(), 1e-12);
    EXPECT_LE((p.driven[0].velocity_at(p.center[20]) - Vec2(0.0, 6.4)).norm(), 1e-12);
    EXPECT_LE((p.driven[58].position(p.center[78], 4.0) - Vec2(4.0, 0.1)).norm(), 1e-12);
}

TEST(DrivenGrains, MayNotLieOnTheGrains) {
    const std::string ring = "[[driven]]\ncenter_x = 5\ncenter_y = 4\nradius = 2\ndisc_radius = 0.2\n";
    try {
        make_packing(parse(head + ring + std::string(stage)));
        FAIL() << "nothing was noticed";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("driven.0 lies on grain"), std::string::npos);
    }
}

}  // namespace
}  // namespace softgrain::test
