// The batched chord against a long double bisection, against chord_of, and against itself.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "chord_lanes.hpp"
#include "random_ellipses.hpp"
#include "sdem/geometry/chord_variants.hpp"

namespace softgrain::sdem {
namespace {

using test::bits_of;
using test::ends_of;
using test::LaneBits;
using test::long_chord;
using test::LongChord;
using test::RandomPair;
using test::set_lane;

ChordBatch solved(const Ellipse& a, const Ellipse& b, const WarmStart& warm) {
    ChordBatch batch;
    batch.count = 1;
    set_lane(batch, 0, a, b, warm);
    solve_chords(batch);
    return batch;
}

double relative(double value, long double expected) {
    return static_cast<double>(std::abs(static_cast<long double>(value) / expected - 1.0L));
}

/// Largest error of lane 0, relative to each quantity; of the mid-point to the unit radius.
double largest_error(const ChordBatch& batch, const Ellipse& a, const LongChord& e) {
    const double nx = static_cast<double>(e.nx), ny = static_cast<double>(e.ny);
    const double length = std::hypot(batch.chord_x[0], batch.chord_y[0]);
    const double sine = std::abs(batch.chord_x[0] * ny - batch.chord_y[0] * nx) / length;
    const double middle =
        std::hypot(a.center.x() + batch.mid_x[0] - static_cast<double>((e.p.x + e.q.x) / 2),
                   a.center.y() + batch.mid_y[0] - static_cast<double>((e.p.y + e.q.y) / 2));
    return std::max({relative(length, e.length), relative(batch.depth[0], e.depth_i + e.depth_j),
                     relative(batch.cap_a[0], e.cap_i), relative(batch.cap_b[0], e.cap_j), sine, middle});
}

struct Level {
    double depth;  ///< depth / R of the smaller grain
    double strain;
    int pairs;
    double tolerance;  ///< as for chord_of: the conditioning is eps / depth
};
class BatchAgainstLongDouble : public testing::TestWithParam<Level> {};

TEST_P(BatchAgainstLongDouble, EveryQuantity) {
    const auto [depth, strain, pairs, tolerance] = GetParam();
    std::mt19937_64 random(7);
    double worst = 0.0;
    int sound = 0;
    for (int k = 0; k < pairs; ++k) {
        const RandomPair pair(random, strain, 0.3);
        const double overlap = 2.0 * depth * pair.R_j;
        WarmStart warm;
        chord_of(pair.i, pair.j((k % 2 == 0 ? 0.9 : 1.1) * overlap), warm);
        const Ellipse j = pair.j(overlap);
        const ChordBatch batch = solved(pair.i, j, warm);
        const bool one_minimum = detail::Level(pair.i, j).has_one_minimum();
        ASSERT_EQ(batch.sound[0], one_minimum ? 1.0 : 0.0) << "pair " << k;
        if (!one_minimum) continue;
        ++sound;
        const double error = largest_error(batch, pair.i, long_chord(pair.i, j));
        EXPECT_TRUE(error < tolerance) << "pair " << k << ": " << error;
        worst = std::max(worst, error);
        WarmStart cold;
        const Chord c = chord_of(pair.i, j, cold);
        EXPECT_NEAR(batch.cover_a[0], c.psi_i, tolerance * c.psi_i);
        EXPECT_NEAR(batch.cover_b[0], c.psi_j, tolerance * c.psi_j);
        EXPECT_NEAR((ends_of(batch, 0).a - cold.a).norm(), 0.0, tolerance * c.psi_j);
        EXPECT_NEAR((ends_of(batch, 0).b - cold.b).norm(), 0.0, tolerance * c.psi_j);
    }
    EXPECT_GE(sound, pairs * 95 / 100);
    RecordProperty("worst_relative_error", fmt::format("{:.2e}", worst));
}

INSTANTIATE_TEST_SUITE_P(Depths, BatchAgainstLongDouble,
                         testing::Values(Level{0.15, 0.2, 400, 1e-12}, Level{0.1, 0.3, 400, 1e-12},
                                         Level{1e-2, 0.3, 400, 1e-12}, Level{1e-3, 0.3, 400, 2e-12},
                                         Level{1e-4, 0.3, 400, 2e-11}, Level{1e-5, 0.3, 400, 2e-10}));

/// 64 contacts of all sorts: sliding, opening, closing, strongly deformed, cold.
ChordBatch mixed_batch(std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    ChordBatch batch;
    batch.count = ChordBatch::capacity;
    for (int k = 0; k < batch.count; ++k) {
        const RandomPair pair(random, 0.05 + 0.6 * unit(random), 0.3);
        const double overlap = std::pow(10.0, -5.0 + 5.0 * unit(random));
        WarmStart warm;
        if (unit(random) > 0.1) chord_of(pair.i, pair.j(overlap * (0.3 + unit(random))), warm);
        set_lane(batch, k, pair.i, pair.j(unit(random) < 0.1 ? -overlap : overlap), warm);
    }
    return batch;
}

void copy_lane(const ChordBatch& from, int k, ChordBatch& to, int n) {
    using Lanes = ChordBatch::Lanes;
    for (Lanes ChordBatch::*lanes :
         {&ChordBatch::dx, &ChordBatch::dy, &ChordBatch::a_xx, &ChordBatch::a_xy, &ChordBatch::a_yx,
          &ChordBatch::a_yy, &ChordBatch::b_xx, &ChordBatch::b_xy, &ChordBatch::b_yx, &ChordBatch::b_yy,
          &ChordBatch::end_ax, &ChordBatch::end_ay, &ChordBatch::end_bx, &ChordBatch::end_by})
        (to.*lanes)[n] = (from.*lanes)[k];
}

/// Equal bits; what an unsound lane holds besides its ends does not count.
void expect_same_lane(const ChordBatch& one, int k, const ChordBatch& other, int n) {
    const LaneBits a = bits_of(one, k), b = bits_of(other, n);
    for (std::size_t v = one.sound[k] == 1.0 ? 0 : 9; v < a.size(); ++v)
        EXPECT_EQ(a[v], b[v]) << "lane " << k << " against " << n << ", value " << v;
}

TEST(ChordBatch, BitsDoNotDependOnPlaceOrNeighbours) {
    const ChordBatch start = mixed_batch(3);
    ChordBatch whole = start;
    solve_chords(whole);
    const auto sound = std::count(whole.sound, whole.sound + whole.count, 1.0);
    EXPECT_GT(sound, 20);
    EXPECT_LT(sound, whole.count);
    const double nan = std::numeric_limits<double>::quiet_NaN(),
                 inf = std::numeric_limits<double>::infinity();
    for (int k = 0; k < start.count; ++k)
        for (int place : {0, 5, 63}) {
            // Other lanes hold what a solver might leave there.
            ChordBatch lonely;
            lonely.count = place + 1;
            for (int n = 0; n < ChordBatch::capacity; ++n) {
                lonely.dx[n] = n % 3 == 0 ? nan : inf;
                lonely.end_ax[n] = n % 2 == 0 ? 1e300 : -1.0;
            }
            copy_lane(start, k, lonely, place);
            solve_chords(lonely);
            expect_same_lane(whole, k, lonely, place);
        }
}

TEST(ChordBatch, BitsDoNotDependOnTheInstructionSet) {
    for (const ChordVariant& variant : chord_variants()) {
        if (!variant.runs) continue;
        SCOPED_TRACE(variant.name);
        for (std::uint64_t seed = 10; seed < 30; ++seed) {
            ChordBatch expected = mixed_batch(seed), batch = expected;
            solve_chords(expected);
            variant.solve(batch);
            for (int k = 0; k < batch.count; ++k) expect_same_lane(expected, k, batch, k);
        }
    }
}

TEST(ChordBatch, AGuessRoundedToFloatGivesTheSameChord) {
    std::mt19937_64 random(21);
    for (int k = 0; k < 200; ++k) {
        const RandomPair pair(random, 0.3, 0.3);
        const double depth = 1e-4 * (1 + k);
        WarmStart warm;
        chord_of(pair.i, pair.j(depth), warm);
        const WarmStart rounded{warm.a.cast<float>().cast<double>(), warm.b.cast<float>().cast<double>()};
        const Ellipse j = pair.j(0.98 * depth);
        const ChordBatch fine = solved(pair.i, j, warm), coarse = solved(pair.i, j, rounded);
        ASSERT_EQ(coarse.sound[0], 1.0);
        EXPECT_LT(relative(coarse.depth[0], fine.depth[0]), 4e-15 / depth);
        EXPECT_LT(relative(coarse.cap_b[0], fine.cap_b[0]), 4e-15 / depth);
        EXPECT_NEAR(ends_of(coarse, 0).a.norm(), 1.0, 5e-16);
        EXPECT_NEAR(ends_of(coarse, 0).b.norm(), 1.0, 5e-16);
    }
}

/// Whatever the guess: a lane that calls itself sound is right.
TEST(ChordBatch, NeverSoundAndWrong) {
    std::mt19937_64 random(13);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    int sound = 0;
    for (int k = 0; k < 20000; ++k) {
        const Ellipse i = make_ellipse(Vec2::Zero(), test::random_F(random, 0.7), 1.0);
        const Ellipse j = make_ellipse(Vec2{1.8 * unit(random), 1.8 * unit(random)},
                                       test::random_F(random, 0.7), 0.5 + 0.4 * unit(random));
        WarmStart cold, warm;
        const Chord c = chord_of(i, j, cold);
        const auto guess = [&](const Vec2& end) {
            const double off = std::pow(10.0, -2.0 + 2.0 * unit(random));
            const Vec2 u = c.touching() ? end : Vec2::UnitX();
            return Vec2{(u + (unit(random) > 0.0 ? off : -off) * perpendicular(u)).normalized()};
        };
        warm = {guess(cold.a), guess(cold.b)};
        if (k % 5 == 0) std::swap(warm.a, warm.b);
        const ChordBatch batch = solved(i, j, warm);
        if (batch.sound[0] == 0.0) {
            EXPECT_EQ(ends_of(batch, 0).a, warm.a);
            EXPECT_EQ(ends_of(batch, 0).b, warm.b);
            continue;
        }
        ++sound;
        ASSERT_EQ(c.overlap, Overlap::chord) << "pair " << k;
        const double tolerance = 1e-13 / (c.psi_j * c.psi_j) * c.length;
        EXPECT_NEAR(batch.chord_x[0], c.length * c.normal.x(), tolerance) << "pair " << k;
        EXPECT_NEAR(batch.chord_y[0], c.length * c.normal.y(), tolerance) << "pair " << k;
        EXPECT_NEAR(batch.depth[0], c.depth_i + c.depth_j, tolerance) << "pair " << k;
        EXPECT_NEAR(batch.cap_a[0], c.cap_i, tolerance) << "pair " << k;
        EXPECT_NEAR(batch.cap_b[0], c.cap_j, tolerance) << "pair " << k;
    }
    EXPECT_GT(sound, 1000);
    RecordProperty("sound", sound);
}

TEST(ChordBatch, HandsOverWhatItCannotDo) {
    const auto is_sound = [](const Ellipse& a, const Ellipse& b, const WarmStart& warm) {
        return solved(a, b, warm).sound[0] == 1.0;
    };
    const Ellipse disc = make_ellipse(Vec2::Zero(), Mat2::Identity(), 1.0);
    const auto at = [](double x, double R) { return make_ellipse(Vec2{x, 0.0}, Mat2::Identity(), R); };
    WarmStart warm;
    chord_of(disc, at(1.45, 0.5), warm);
    EXPECT_TRUE(is_sound(disc, at(1.45, 0.5), warm));
    EXPECT_FALSE(is_sound(disc, at(1.45, 0.5), WarmStart{})) << "cold";
    EXPECT_FALSE(is_sound(disc, at(1.501, 0.5), warm)) << "opened";
    EXPECT_FALSE(is_sound(disc, at(0.3, 0.5), warm)) << "contained";
    EXPECT_FALSE(is_sound(disc, disc, warm)) << "coincident";
    EXPECT_FALSE(is_sound(disc, at(1.45, 0.5), {1.01 * warm.a, 1.01 * warm.b})) << "guess off the circle";
    const WarmStart deepest{-Vec2::UnitX(), -Vec2::UnitX()};
    EXPECT_FALSE(is_sound(disc, at(1.45, 0.5), deepest)) << "apart until now";
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(is_sound(disc, at(nan, 0.5), warm)) << "not a number";

    const Ellipse deep = at(0.8, 0.5);
    chord_of(disc, deep, warm);
    EXPECT_FALSE(is_sound(disc, deep, warm)) << "more than half a disc";

    // A thin grain along the edge of the disc: both tips outside, and its upper side too but for the middle.
    Mat2 thin;
    thin << 1.2, 0.0, 0.0, 0.1;
    const Ellipse j = make_ellipse(Vec2{0.0, 0.94}, thin, 0.5);
    const Chord pocket = chord_of(disc, j, warm);
    ASSERT_EQ(pocket.overlap, Overlap::four_points);
    const Vec2 half = 0.5 * pocket.length * perpendicular(pocket.normal);
    warm = {j.inverse * (pocket.point + half - j.center), j.inverse * (pocket.point - half - j.center)};
    EXPECT_FALSE(is_sound(disc, j, warm)) << "four points, from the very ends of a chord";
}

/// Slow compaction: the ends of one call start the next, and nearly no lane is handed over.
TEST(ChordBatch, FollowsMovingContacts) {
    std::mt19937_64 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    constexpr int pairs = ChordBatch::capacity, calls = 300;
    std::vector<RandomPair> pair;
    std::vector<double> overlap, rate;
    std::vector<WarmStart> kept(pairs);
    ChordBatch batch;
    batch.count = pairs;
    for (int k = 0; k < pairs; ++k) {
        pair.emplace_back(random, 0.25, 0.5);
        overlap.push_back(std::pow(10.0, -3.0 + 2.3 * unit(random)));
        rate.push_back(1e-4 * unit(random));
        chord_of(pair.back().i, pair.back().j(overlap.back()), kept[k]);
    }
    int handed_over = 0;
    for (int call = 0; call < calls; ++call) {
        for (int k = 0; k < pairs; ++k) {
            overlap[k] += rate[k];
            set_lane(batch, k, pair[k].i, pair[k].j(overlap[k]), kept[k]);
        }
        solve_chords(batch);
        for (int k = 0; k < pairs; ++k) {
            if (batch.sound[k] == 0.0) ++handed_over;
            const Chord c = chord_of(pair[k].i, pair[k].j(overlap[k]), kept[k]);
            if (batch.sound[k] == 0.0) continue;
            EXPECT_NEAR(batch.depth[k], c.depth_i + c.depth_j, 1e-14);
            EXPECT_NEAR(batch.cap_b[k], c.cap_j, 1e-14);
            kept[k] = ends_of(batch, k);
        }
    }
    RecordProperty("handed_over", handed_over);
    EXPECT_LE(handed_over, pairs * calls / 1000);
}

}  // namespace
}  // namespace softgrain::sdem
