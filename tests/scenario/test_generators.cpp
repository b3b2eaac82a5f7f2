// What every generator promises, and what each alone does.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <string>

#include "common/errors.hpp"
#include "common/packing/generators.hpp"
#include "common/packing/jam.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/size_laws.hpp"
#include "tests/scenario/examined_packing.hpp"

namespace softgrain::test {
namespace {

struct Made {
    std::vector<double> radii;
    Packing packing;
};

Made made(Generator generator, const PackingSpec& spec, std::uint64_t seed, double aspect_ratio = 1.0,
          bool periodic = false) {
    Random random(seed);
    std::vector<double> radii = draw_radii(spec, random);
    Packing packing = generate(
        generator, radii,
        {.aspect_ratio = aspect_ratio, .packing_fraction = spec.packing_fraction, .periodic = periodic},
        random);
    return {std::move(radii), std::move(packing)};
}

PackingSpec sizes(int count, std::optional<double> fraction = {}) {
    PackingSpec spec;
    spec.count = count;
    spec.packing_fraction = fraction;
    return spec;
}

std::string error_of(Generator generator, const PackingSpec& spec, bool periodic = false) {
    try {
        made(generator, spec, 1, 1.0, periodic);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

/// A generator, and a packing fraction that it needs.
struct Case {
    Generator generator;
    std::optional<double> fraction;
    bool periodic;
};

class EveryGenerator : public testing::TestWithParam<Case> {};

TEST_P(EveryGenerator, KeepsTheRadiiAndTheBox) {
    const Case& c = GetParam();
    for (const double aspect_ratio : {1.0, 0.5, 3.0}) {
        const Made m = made(c.generator, sizes(80, c.fraction), 2, aspect_ratio, c.periodic);
        EXPECT_EQ(m.packing.radius, m.radii);
        ASSERT_EQ(m.packing.center.size(), m.radii.size());
        EXPECT_EQ(m.packing.box.origin(), Vec2::Zero());
        EXPECT_EQ(m.packing.box.periodic, c.periodic);
        EXPECT_NEAR(m.packing.box.height() / m.packing.box.width(), aspect_ratio, 1e-12 * aspect_ratio);
        EXPECT_GE(smallest_gap(m.packing), -1e-12);
        if (c.fraction) {
            EXPECT_NEAR(m.packing.packing_fraction_undeformed(), *c.fraction, 1e-12);
        }
    }
}

TEST_P(EveryGenerator, TakesSizesFarApart) {
    PackingSpec spec = sizes(200, GetParam().fraction);
    spec.size_law = SizeLaw::fractal;
    spec.radius_min = 0.1;
    spec.radius_max = 1.5;
    const Made m = made(GetParam().generator, spec, 5, 1.0, GetParam().periodic);
    EXPECT_EQ(m.packing.radius, m.radii);
    EXPECT_GE(smallest_gap(m.packing), -1e-12);
}

TEST_P(EveryGenerator, TheSeedDecides) {
    const Case& c = GetParam();
    const auto of_seed = [&](std::uint64_t seed) {
        return bits(made(c.generator, sizes(40, c.fraction), seed, 1.0, c.periodic).packing);
    };
    EXPECT_EQ(of_seed(6), of_seed(6));
    EXPECT_NE(of_seed(6), of_seed(7));
}

TEST_P(EveryGenerator, PutsEllipsesInsideItsDiscs) {
    const Case& c = GetParam();
    Scenario scenario;
    scenario.classes.resize(2);
    scenario.classes[1].aspect_ratio = 2.0;
    scenario.packing.generator = c.generator;
    if (c.fraction) scenario.packing.packing_fraction = 0.25;
    scenario.box = {4.0, 2.0, c.periodic};
    const Packing p = make_packing(scenario);
    Packing around = p;
    for (std::size_t g = 0; g < p.size(); ++g) around.radius[g] = p.reach(g);
    EXPECT_GE(smallest_gap(around), -1e-12);
    EXPECT_EQ(p.box.width(), 4.0);
    EXPECT_EQ(p.box.height(), 2.0);
    if (c.fraction) {
        EXPECT_NEAR(p.packing_fraction_undeformed(), 0.25, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Generators, EveryGenerator,
    testing::Values(Case{Generator::growth, {}, false}, Case{Generator::growth, 0.7, true},
                    Case{Generator::compaction, {}, false}, Case{Generator::compaction, 0.5, false},
                    Case{Generator::geometric, {}, false}, Case{Generator::deposition, {}, false},
                    Case{Generator::random_sequential, 0.4, false},
                    Case{Generator::random_sequential, 0.4, true}));

TEST(Compaction, JamsFrictionlessDiscsIsostatically) {
    // As many contacts as unknowns: 2 positions for each disc that carries, and the box size.
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        Random random(seed);
        const auto radii = draw_radii(sizes(80), random);
        const JammedPacking result = compact(radii, {}, random);
        EXPECT_NEAR(result.contacts, 2 * (80 - result.rattlers) + 1, 2) << "seed " << seed;
        EXPECT_GE(count_touching(result.packing, 4e-6), result.contacts);
        EXPECT_NEAR(result.packing_fraction, 0.79, 0.03) << "as from the inside";
    }
}

TEST(Compaction, PushesFromTheWalls) {
    // Halfway there the discs stand close at the walls and loose in the middle; growth makes no difference.
    const auto share_near_walls = [](Generator generator) {
        const Packing p = made(generator, sizes(400, 0.55), 4).packing;
        int near = 0;
        for (const Vec2& c : p.center) {
            const double x = c.x() / p.box.width(), y = c.y() / p.box.height();
            near += std::min(std::min(x, 1.0 - x), std::min(y, 1.0 - y)) < 0.15 ? 1 : 0;
        }
        return near / 400.0;
    };
    // Half of the area, less the rim of a radius that no centre lies in: 0.466 +- 0.025.
    EXPECT_NEAR(share_near_walls(Generator::growth), 0.466, 0.06);
    EXPECT_GT(share_near_walls(Generator::compaction), 0.6);
}

TEST(Compaction, NeedsWallsAndAFractionBelowJamming) {
    EXPECT_EQ(error_of(Generator::compaction, sizes(10), true),
              "packing.generator = \"compaction\" needs walls: use \"growth\" in a periodic cell");
    EXPECT_TRUE(error_of(Generator::compaction, sizes(60, 0.9))
                    .starts_with("packing.packing_fraction 0.9 cannot be reached: these grains jam at 0."));
}

TEST(Geometric, EveryDiscTouchesTwoOthersAndItIsDense) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
        const Packing p = made(Generator::geometric, sizes(600), seed).packing;
        std::vector<int> touching(p.size(), 0);
        for (std::size_t i = 0; i < p.size(); ++i)
            for (std::size_t j = 0; j < p.size(); ++j) {
                const double gap = (p.center[i] - p.center[j]).norm() - p.radius[i] - p.radius[j];
                touching[i] += i != j && gap < 1e-9 ? 1 : 0;
            }
        EXPECT_GE(*std::min_element(touching.begin(), touching.end()), 2);
        // Each disc brings two contacts, the first two one less each, and rarely more by chance.
        EXPECT_NEAR(std::accumulate(touching.begin(), touching.end(), 0), 2 * (2 * 600 - 3), 8);
        EXPECT_GT(p.packing_fraction_undeformed(), 0.72) << "seed " << seed;
    }
}

TEST(Geometric, EqualDiscsMakeALattice) {
    PackingSpec spec = sizes(7);
    spec.size_law = SizeLaw::single;
    const Packing p = made(Generator::geometric, spec, 1).packing;
    // Six around one: 6 diameters along x or y, sqrt(3) + 1 across.
    EXPECT_NEAR(p.box.width(), 6.0, 1e-9);
    spec.count = 2;
    EXPECT_NEAR(made(Generator::geometric, spec, 1).packing.box.width(), 4.0, 1e-9);
    spec.count = 1;
    EXPECT_NEAR(made(Generator::geometric, spec, 1).packing.box.width(), 2.0, 1e-9);
}

TEST(Geometric, LeavesThePackingFractionAndPeriodsToOthers) {
    EXPECT_EQ(error_of(Generator::geometric, sizes(10), true),
              "packing.generator = \"geometric\" needs walls: use \"growth\" in a periodic cell");
    EXPECT_EQ(
        error_of(Generator::geometric, sizes(10, 0.5)),
        "packing.packing_fraction has no effect with generator = \"geometric\", what comes of it is not "
        "controlled: remove it");
}

TEST(Deposition, EveryDiscIsHeldAgainstGravity) {
    constexpr double near = 1e-4;  // the box was opened by 1e-5
    for (const std::uint64_t seed : {1U, 2U}) {
        const Packing p = made(Generator::deposition, sizes(120), seed).packing;
        int held = 0;
        double highest = 0.0, rightmost = 0.0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Vec2& c = p.center[i];
            const double reach = p.radius[i] + near;
            highest = std::max(highest, c.y() + p.radius[i]);
            rightmost = std::max(rightmost, c.x() + p.radius[i]);
            const bool on_floor = c.y() < reach;
            bool below = on_floor, left = on_floor || c.x() < reach,
                 right = on_floor || p.box.width() - c.x() < reach;
            for (std::size_t j = 0; j < p.size(); ++j) {
                const Vec2 to_j = p.center[j] - c;
                if (i == j || to_j.norm() > p.radius[j] + reach) continue;
                below = below || to_j.y() < 0.0;
                (to_j.x() < 0.0 ? left : right) = true;
            }
            held += below && left && right ? 1 : 0;
        }
        EXPECT_EQ(held, 120) << "seed " << seed;
        EXPECT_LT(p.box.height() - highest, 2.5 * p.mean_radius());
        EXPECT_LT(p.box.width() - rightmost, near);
        EXPECT_GT(p.packing_fraction_undeformed(), 0.7);
    }
}

TEST(Deposition, AFewDiscs) {
    PackingSpec spec = sizes(1);
    spec.size_law = SizeLaw::single;
    const Packing one = made(Generator::deposition, spec, 1).packing;
    EXPECT_NEAR(one.center[0].y(), 1.0, 1e-3);
    spec.count = 2;
    const Packing two = made(Generator::deposition, spec, 1).packing;
    EXPECT_NEAR(std::min(two.center[0].y(), two.center[1].y()), 1.0, 1e-3);
    EXPECT_NEAR((two.center[0] - two.center[1]).norm(), 2.0, 1e-3);
}

TEST(Deposition, LeavesThePackingFractionAndPeriodsToOthers) {
    EXPECT_EQ(error_of(Generator::deposition, sizes(10), true),
              "packing.generator = \"deposition\" needs walls: use \"growth\" in a periodic cell");
    EXPECT_TRUE(
        error_of(Generator::deposition, sizes(10, 0.5)).starts_with("packing.packing_fraction has no"));
}

TEST(RandomSequential, PlacesAreUniformWhereThereIsRoom) {
    // 2000 discs that leave nearly all places free: their coordinates are uniform by Kolmogorov and Smirnov.
    const Made m = made(Generator::random_sequential, sizes(2000, 0.01), 3, 2.0, true);
    for (const int axis : {0, 1}) {
        std::vector<double> places;
        for (const Vec2& c : m.packing.center)
            places.push_back(c[axis] / (axis == 0 ? m.packing.box.width() : m.packing.box.height()));
        std::sort(places.begin(), places.end());
        double largest = 0.0;
        for (std::size_t k = 0; k < places.size(); ++k)
            largest = std::max(largest, std::abs(places[k] - (static_cast<double>(k) + 0.5) / 2000.0));
        EXPECT_LT(largest, 1.95 / std::sqrt(2000.0)) << "axis " << axis;
    }
}

TEST(RandomSequential, EqualDiscsSaturateWhereTheyAreKnownTo) {
    // Infinite samples saturate at 0.5470; a million trials for a disc end a little before.
    PackingSpec spec = sizes(400, 0.6);
    spec.size_law = SizeLaw::single;
    const std::string text = error_of(Generator::random_sequential, spec, true);
    const std::string before =
        "packing.packing_fraction 0.6 cannot be reached by random places: there was no "
        "room left at ";
    ASSERT_TRUE(text.starts_with(before)) << text;
    // Standard deviation of 320 placed discs: 0.3 / sqrt(640) of the fraction, about 0.01.
    EXPECT_NEAR(std::stod(text.substr(before.size())), 0.545, 0.02) << text;
    spec.packing_fraction = 0.5;
    EXPECT_EQ(error_of(Generator::random_sequential, spec, true), "");
}

TEST(RandomSequential, NeedsAPackingFraction) {
    EXPECT_EQ(
        error_of(Generator::random_sequential, sizes(10)),
        "packing.generator = \"random_sequential\" has no end of its own: give packing.packing_fraction");
}

}  // namespace
}  // namespace softgrain::test
