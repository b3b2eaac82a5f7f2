#include <gtest/gtest.h>
#include <omp.h>

#include <cmath>
#include <limits>
#include <random>

#include "bpm/attraction.hpp"
#include "bpm/power.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {

#if defined(SOFTGRAIN_ATTRACTION_VARIANTS)
#define SOFTGRAIN_ATTRACTION_VARIANT(level)                                           \
    void attract_##level(const AttractionLaw&, const StripedDiscs&, double*);         \
    void find_potentials_##level(const AttractionLaw&, const StripedDiscs&, double*); \
    double largest_square_move_##level(const StripedDiscs&, const double*, const double*);
SOFTGRAIN_ATTRACTION_VARIANT(v2)
SOFTGRAIN_ATTRACTION_VARIANT(v3)
SOFTGRAIN_ATTRACTION_VARIANT(v4)
#endif

namespace {

struct Discs {
    std::vector<Vec2> x;
    std::vector<double> radius;
};

Discs random_discs(unsigned seed, int count, double ratio = 1.5) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    Discs discs;
    const double side = 0.6 * std::sqrt(static_cast<double>(count));
    for (int k = 0; k < count; ++k) {
        discs.x.emplace_back(side * unit(random), side * unit(random));
        discs.radius.push_back(0.6 / ratio + (0.6 - 0.6 / ratio) * unit(random));
    }
    return discs;
}

/// All pairs of each grain by the law as printed.
std::vector<Vec2> plain_forces(const AttractionLaw& law, const Discs& discs, const std::vector<int>& start) {
    std::vector<Vec2> force(discs.x.size(), Vec2::Zero());
    for (std::size_t g = 0; g + 1 < start.size(); ++g)
        for (auto i = static_cast<std::size_t>(start[g]); i < static_cast<std::size_t>(start[g + 1]); ++i)
            for (auto j = static_cast<std::size_t>(start[g]); j < static_cast<std::size_t>(start[g + 1]);
                 ++j) {
                const Vec2 line = discs.x[j] - discs.x[i];
                if (i != j)
                    force[i] += law.force(line.norm(), discs.radius[i] + discs.radius[j]) * line.normalized();
            }
    return force;
}

double largest(const std::vector<Vec2>& a) {
    double most = 0.0;
    for (const Vec2& v : a) most = std::max(most, v.norm());
    return most;
}

const std::vector<AttractionLaw> laws{
    {2.5, 7.0, 1.0},  {1.0, 7.0, 0.4}, {1.3, 2.0, 1.0},        {1.0, 1.0, 2.0},   {1.0, 1.5, 1.0},
    {0.7, 12.0, 1.0}, {1.0, 3.0, 3.7}, {1.0, 30.0, 0.5},       {1.0, 4.0, 10.0},  {1.0, 7.0, 0.05},
    {1e6, 6.0, 1.0},  {1.0, 2.5, 0.2}, {1.0, 1.0 + 1e-9, 1.0}, {1.0, 1.001, 1.0},
};

TEST(Attraction, EqualsThePrintedLawWithPow) {
    for (const AttractionLaw& law : laws)
        for (double ratio : {1.5, 20.0}) {
            const Discs discs = random_discs(1, 90, ratio);
            const std::vector<int> start{0, 40, 90};
            Attraction attraction(law, start, discs.radius, 0.3);
            std::vector<Vec2> force(discs.x.size());
            attraction.forces(discs.x, 0.0, force, false);
            const std::vector<Vec2> expected = plain_forces(law, discs, start);
            const double bound = 1e-13 * law.maximum_force * (1.0 + largest(expected) / law.maximum_force);
            for (std::size_t d = 0; d < force.size(); ++d)
                ASSERT_LT((force[d] - expected[d]).norm(), law.exponent == 1.0 + 1e-9 ? 1e-7 : bound)
                    << d << ", gamma " << law.exponent << ", range " << law.range;
        }
}

TEST(Attraction, ThePrintedLawIsTheDerivativeOfThePotential) {
    for (const AttractionLaw& law : laws) {
        const double a0 = 0.9, end = a0 * law.cut_off();
        for (double at :
             {0.7, 0.85, 0.99, 1.0 + 0.1 * law.range, 1.0 + 0.5 * law.range, 1.0 + 0.95 * law.range}) {
            const double distance = at * a0, e = 1e-6;
            const double slope =
                (law.potential(distance + e, a0) - law.potential(distance - e, a0)) / (2.0 * e);
            // Second-order difference: e^2 times the second derivative of the force, below gamma^2 / a0^2.
            EXPECT_NEAR(slope / law.force(distance, a0), 1.0, 1e-8) << at << ", gamma " << law.exponent;
        }
        EXPECT_EQ(law.potential(1.001 * end, a0), 0.0);
        EXPECT_NEAR(law.potential(end * (1.0 - 1e-9), a0), 0.0, 2e-9 * law.maximum_force * end);
    }
    const AttractionLaw paper{1.7};
    EXPECT_NEAR(paper.potential(0.9, 0.9), -1.7 * 0.9 * 63.0 / 384.0, 1e-14);
}

TEST(Attraction, EnergySumsThePairsOfEachGrain) {
    for (const AttractionLaw& law : laws) {
        const Discs discs = random_discs(2, 60);
        Attraction attraction(law, {0, 25, 60}, discs.radius, 0.3);
        EXPECT_EQ(attraction.energy(discs.x), 0.0);  // no neighbours are known yet
        std::vector<Vec2> force(discs.x.size());
        attraction.forces(discs.x, 0.0, force, false);
        double expected = 0.0;
        for (std::size_t i = 0; i < 60; ++i)
            for (std::size_t j = i + 1; j < 60; ++j)
                if ((i < 25) == (j < 25))
                    expected +=
                        law.potential((discs.x[i] - discs.x[j]).norm(), discs.radius[i] + discs.radius[j]);
        // Beside gamma = 1 the difference of two powers over (gamma - 1) loses digits.
        const double digits = law.exponent == 1.0 + 1e-9 ? 1e-7 : 1e-12;
        EXPECT_NEAR(attraction.energy(discs.x), expected, digits * std::abs(expected)) << law.exponent;
    }
}

TEST(Attraction, NeighboursFollowMovingDiscs) {
    // Steps below the skin, a drift of the whole, and a slow shear: always the same as a fresh all-pairs sum.
    for (double skin : {0.05, 0.2, 0.8}) {
        const AttractionLaw law{1.0};
        Discs discs = random_discs(3, 50);
        Attraction attraction(law, {0, 50}, discs.radius, skin);
        std::vector<Vec2> force(50);
        for (int step = 0; step < 40; ++step) {
            attraction.forces(discs.x, 0.0, force);
            const std::vector<Vec2> expected = plain_forces(law, discs, {0, 50});
            for (std::size_t d = 0; d < 50; ++d) ASSERT_LT((force[d] - expected[d]).norm(), 1e-12) << step;
            for (Vec2& x : discs.x) x += Vec2(0.5 + 0.02 * x.y(), 0.3);
        }
        EXPECT_GT(attraction.rebuilds(), 1);
        EXPECT_LE(attraction.rebuilds(), 40);
    }
}

TEST(Attraction, AGrainThatDriftsAsAWholeKeepsItsNeighbours) {
    Discs discs = random_discs(4, 50);
    Attraction attraction({1.0}, {0, 50}, discs.radius, 0.1);
    std::vector<Vec2> force(50);
    for (int step = 0; step < 20; ++step) {
        attraction.forces(discs.x, 0.0, force);
        for (Vec2& x : discs.x) x += Vec2(3.0, -1.0);
    }
    EXPECT_EQ(attraction.rebuilds(), 1);
}

TEST(Attraction, SameBitsForOneAndTwoThreads) {
    const Discs discs = random_discs(5, 1200);
    std::vector<std::vector<Vec2>> forces;
    std::vector<double> energies;
    for (int threads : {1, 2}) {
        omp_set_num_threads(threads);
        Attraction attraction({1.0}, {0, 300, 600, 1000, 1200}, discs.radius, 0.3);
        forces.emplace_back(discs.x.size());
        attraction.forces(discs.x, 0.0, forces.back(), false);
        energies.push_back(attraction.energy(discs.x));
    }
    omp_set_num_threads(1);
    EXPECT_EQ(forces[0], forces[1]);
    EXPECT_EQ(energies[0], energies[1]);
}

TEST(Attraction, ManyEqualAndOneLoneDisc) {
    // Two discs on one spot attract with force 0, one disc with none.
    const std::vector<double> radius{0.5, 0.5, 0.5};
    const std::vector<Vec2> x{{1.0, 2.0}, {1.0, 2.0}, {1.0, 2.0}};
    Attraction attraction({1.0}, {0, 2, 3}, radius, 0.3);
    std::vector<Vec2> force(3, Vec2::Ones());
    attraction.forces(x, 0.0, force);
    for (const Vec2& f : force) EXPECT_EQ(f, Vec2::Zero());
    EXPECT_NEAR(attraction.energy(x), -63.0 / 384.0 - 0.5, 1e-15);
}

TEST(Attraction, CountsLostDiscsUntilThereAreTooMany) {
    // A row of 60 discs that touch each other; one, then two of them far away.
    Discs row;
    for (int k = 0; k < 60; ++k) {
        row.x.emplace_back(k, 0.0);
        row.radius.push_back(0.5);
    }
    Attraction attraction({1.0}, {0, 60}, row.radius, 0.3);
    std::vector<Vec2> force(60);
    attraction.forces(row.x, 0.0, force);
    EXPECT_EQ(attraction.lost_discs(0), 0);
    row.x[59].y() = 10.0;
    attraction.forces(row.x, 0.0, force);
    EXPECT_EQ(attraction.lost_discs(0), 1);
    EXPECT_EQ(force[59], Vec2(0.0, 0.0));
    row.x[0].y() = 20.0;
    EXPECT_THROW(attraction.forces(row.x, 0.0, force), DivergedError);
}

TEST(Attraction, NamesTheGrainThatLostADisc) {
    Discs discs{{{0, 0}, {1, 0}, {10, 0}, {11, 0}, {30, 0}}, {0.5, 0.5, 0.5, 0.5, 0.5}};
    Attraction attraction({1.0}, {0, 2, 5}, discs.radius, 0.3);
    std::vector<Vec2> force(5);
    try {
        attraction.forces(discs.x, 1.5, force);
        FAIL() << "no error";
    } catch (const DivergedError& error) {
        EXPECT_EQ(error.grain, 1);
        EXPECT_EQ(error.time, 1.5);
    }
    Attraction unassembled({1.0}, {0, 2, 5}, discs.radius, 0.3);
    EXPECT_NO_THROW(unassembled.forces(discs.x, 1.5, force, false));
}

TEST(Attraction, RefusesLawsBeyondItsBounds) {
    const std::vector<double> radius{0.5, 0.5};
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (const AttractionLaw& law : std::vector<AttractionLaw>{
             {0.0}, {-1.0}, {nan}, {1.0, 0.9}, {1.0, 31.0}, {1.0, nan}, {1.0, 7.0, 0.0}, {1.0, 7.0, 11.0}})
        EXPECT_THROW(Attraction(law, {0, 2}, radius, 0.3), InputError) << law.exponent << " " << law.range;
    EXPECT_THROW(Attraction({1.0}, {0, 2}, radius, 0.0), InputError);
}

#if defined(SOFTGRAIN_ATTRACTION_VARIANTS)
TEST(Attraction, SameBitsForEveryInstructionSet) {
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has one instruction set only";
    const bool has_v4 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
                        __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw");
    Discs discs = random_discs(6, 200);
    for (const AttractionLaw& law : laws) {
        DiscStripes stripes;
        stripes.build(discs.x, discs.radius, law.cut_off(), 0.3);
        const StripedDiscs striped = stripes.discs();
        std::vector<double> x_before(striped.x, striped.x + striped.slots);
        std::vector<double> y_before(striped.y, striped.y + striped.slots);
        for (double& x : x_before) x *= 1.01;
        const auto result = [&](auto attract_by, auto potentials_by, auto move_by) {
            std::vector<double> all(601, -1.0);
            attract_by(law, striped, all.data());
            potentials_by(law, striped, all.data() + 400);
            all[600] = move_by(striped, x_before.data(), y_before.data());
            return all;
        };
        const std::vector<double> dispatched = result(&attract, &find_potentials, &largest_square_move);
        EXPECT_EQ(result(&attract_v2, &find_potentials_v2, &largest_square_move_v2), dispatched);
        EXPECT_EQ(result(&attract_v3, &find_potentials_v3, &largest_square_move_v3), dispatched);
        if (has_v4) {
            EXPECT_EQ(result(&attract_v4, &find_potentials_v4, &largest_square_move_v4), dispatched);
        }
    }
}
#endif

TEST(Power, EqualsTheLibrarys) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int k = 0; k < 20000; ++k) {
        const double q = std::pow(10.0, -6.0 * unit(random)), p = 16.0 * unit(random);
        EXPECT_NEAR(binary_logarithm(q), std::log2(q), 3e-16 * (1.0 + std::abs(std::log2(q)))) << q;
        // The error of the exponent, p log2(q) times a few 1e-16, is that of the power.
        const double digits = 4e-16 * (1.0 + p * std::abs(std::log2(q)));
        EXPECT_NEAR(power_of(q, p) / std::pow(q, p), 1.0, digits) << q << "^" << p;
    }
    EXPECT_EQ(power_of(1.0, 7.3), 1.0);
    EXPECT_EQ(power_of(0.3, 0.0), 1.0);
    EXPECT_DOUBLE_EQ(power_of(0.25, 0.5), 0.5);
    EXPECT_EQ(power_of(1e-200, 30.0), 0x1p-1000);
}

}  // namespace
}  // namespace softgrain::bpm
