// Generated packings, examined with all pairs one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/size_laws.hpp"
#include "tests/scenario/examined_packing.hpp"

namespace softgrain {
namespace {

using test::bits;
using test::count_touching;
using test::smallest_gap;

JammedPacking jammed(int count, std::uint64_t seed, double aspect_ratio = 1.0, PackingSpec spec = {}) {
    spec.count = count;
    Random random(seed);
    const auto radii = draw_radii(spec, random);
    return jam(radii, {.aspect_ratio = aspect_ratio, .packing_fraction = spec.packing_fraction}, random);
}

PackingSpec until(double packing_fraction) {
    PackingSpec spec;
    spec.packing_fraction = packing_fraction;
    return spec;
}

PackingSpec with_law(SizeLaw law) {
    PackingSpec spec;
    spec.size_law = law;
    return spec;
}

TEST(Jam, FrictionlessDiscsJamIsostatic) {
    // 2 N unknown positions and the box size: as many contacts as unknowns. Of 1500 seeds of 50 grains 47
    // miss one contact, which carries less than the least force that is counted.
    for (const std::uint64_t seed : {1U, 2U, 3U, 4U}) {
        const JammedPacking result = jammed(60, seed);
        const int carried = 60 - result.rattlers;
        EXPECT_NEAR(result.contacts, 2 * carried + 1, 2) << "seed " << seed;
        EXPECT_GE(count_touching(result.packing, 1e-5), result.contacts);
        EXPECT_LT(result.rattlers, 12);
        // Small packings lose to the walls: 400 seeds of 50 grains have phi = 0.776 +- 0.010.
        EXPECT_NEAR(result.packing_fraction, 0.776, 0.04);
    }
}

TEST(Jam, MoreGrainsApproachTheKnownPackingFractionAndCoordination) {
    // Frictionless discs without walls: phi 0.84, Z 4; walls lower both at 150 grains.
    const JammedPacking result = jammed(150, 1);
    EXPECT_GT(result.packing_fraction, 0.79);
    EXPECT_LT(result.packing_fraction, 0.85);
    EXPECT_NEAR(result.contacts, 2 * (150 - result.rattlers) + 1, 3);
    // 4 minus twice the number of wall contacts for each grain, about 0.25.
    EXPECT_NEAR(result.coordination_number, 3.5, 0.15);
    EXPECT_GE(smallest_gap(result.packing), -1e-13);
}

TEST(Jam, NothingOverlapsAndContactsTouch) {
    for (const double aspect_ratio : {1.0, 0.25, 3.0}) {
        const JammedPacking result = jammed(50, 11, aspect_ratio);
        EXPECT_GE(smallest_gap(result.packing), -1e-13);
        EXPECT_LT(smallest_gap(result.packing), 1e-12);
        EXPECT_NEAR(result.packing.box.height() / result.packing.box.width(), aspect_ratio, 1e-12);
        EXPECT_NEAR(result.packing_fraction, result.packing.packing_fraction_undeformed(), 1e-15);
    }
}

TEST(Jam, EveryCountedContactIsClosed) {
    // Overlaps of 5e-7 mean radii at most, and the box opened by as much over a distance of up to 4 radii.
    const JammedPacking result = jammed(50, 5);
    EXPECT_GE(count_touching(result.packing, 4e-6 * result.packing.mean_radius()), result.contacts);
}

TEST(Jam, ClosedForms) {
    // One disc fills the square as its inscribed circle, and two walls of a long box.
    EXPECT_NEAR(jammed(1, 1).packing_fraction, std::numbers::pi / 4.0, 1e-6);
    EXPECT_NEAR(jammed(1, 1, 2.0).packing_fraction, std::numbers::pi / 8.0, 1e-6);
    // Two equal discs on the diagonal: side = r (2 + sqrt(2)).
    const double side = 2.0 + std::numbers::sqrt2;
    EXPECT_NEAR(jammed(2, 1, 1.0, with_law(SizeLaw::single)).packing_fraction,
                2.0 * std::numbers::pi / (side * side), 1e-5);
}

TEST(Jam, FractalSizes) {
    PackingSpec spec = with_law(SizeLaw::fractal);
    spec.radius_min = 0.004;
    spec.radius_max = 0.038;
    const JammedPacking result = jammed(150, 2, 1.0, spec);
    EXPECT_NEAR(result.contacts, 2 * (150 - result.rattlers) + 1, 3);
    EXPECT_GE(smallest_gap(result.packing), -1e-14);
    EXPECT_GT(result.packing_fraction, 0.78);
}

TEST(Jam, TheSeedDecides) {
    const auto first = bits(jammed(40, 6).packing);
    EXPECT_EQ(first, bits(jammed(40, 6).packing));
    EXPECT_NE(first, bits(jammed(40, 7).packing));
}

TEST(Jam, StopsAtAPackingFractionBelow) {
    for (const double wanted : {0.05, 0.4, 0.7}) {
        const JammedPacking result = jammed(60, 3, 1.0, until(wanted));
        EXPECT_NEAR(result.packing_fraction, wanted, 1e-12);
        EXPECT_GE(smallest_gap(result.packing), 0.0) << wanted;
        EXPECT_EQ(result.contacts, 0);
    }
}

TEST(Jam, StopsCloseBelowItsJammingPoint) {
    const double limit = jammed(60, 3).packing_fraction;
    const JammedPacking result = jammed(60, 3, 1.0, until(limit - 1e-5));
    EXPECT_NEAR(result.packing_fraction, limit - 1e-5, 1e-12);
    EXPECT_GE(smallest_gap(result.packing), 0.0);
}

TEST(Jam, APackingFractionBeyondJammingIsRefused) {
    try {
        jammed(60, 3, 1.0, until(0.9));
        FAIL() << "0.9 was accepted";
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what())
                      .find("packing.packing_fraction 0.9 cannot be reached: these grains jam at"),
                  std::string::npos)
            << error.what();
    }
}

TEST(MakePacking, TakesTheBoxExactly) {
    Scenario scenario;
    scenario.packing.count = 30;
    scenario.seed = 4;
    const Packing own = make_packing(scenario);
    scenario.box = {0.3, 0.1};
    const Packing scaled = make_packing(scenario);
    EXPECT_EQ(scaled.box.width(), 0.3);
    EXPECT_EQ(scaled.box.height(), 0.1);
    EXPECT_GE(smallest_gap(scaled), -1e-15);
    // The radii keep their proportions.
    const double factor = scaled.radius[0] / own.radius[0];
    for (std::size_t k = 0; k < own.size(); ++k) EXPECT_NEAR(scaled.radius[k] / own.radius[k], factor, 1e-12);
}

TEST(MakePacking, ReadsAFile) {
    Scenario scenario;
    scenario.packing.path = std::string(SOFTGRAIN_TEST_DATA) + "/scenario/three.csv";
    EXPECT_THROW(make_packing(scenario), InputError);
    scenario.box = {4.0, 4.0};
    const Packing packing = make_packing(scenario);
    EXPECT_EQ(packing.size(), 3U);
    EXPECT_EQ(packing.box.height(), 4.0);
}

}  // namespace
}  // namespace softgrain
