// Clumps: union of discs against closed forms and fine sampling, keys of a scenario, packings.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "common/observables/shape.hpp"
#include "common/packing/disc_union.hpp"
#include "common/packing/make_packing.hpp"
#include "common/packing/overlap.hpp"
#include "common/packing/packing_csv.hpp"
#include "tests/scenario/support.hpp"

namespace softgrain::test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(DiscUnion, OneDisc) {
    const std::vector<Disc> one{{{300.0, -20.0}, 0.7}};
    const UnionMoments m = union_moments(one);
    EXPECT_NEAR(m.area, pi * 0.49, 1e-14);
    EXPECT_NEAR((m.centroid - one[0].center).norm(), 0.0, 1e-13);
    EXPECT_NEAR(m.polar_moment, 0.5 * pi * std::pow(0.7, 4), 1e-14);
}

TEST(DiscUnion, DiscsApartAreASum) {
    const std::vector<Disc> two{{{0.0, 0.0}, 1.0}, {{3.0, 4.0}, 2.0}};
    const UnionMoments m = union_moments(two);
    EXPECT_NEAR(m.area, 5.0 * pi, 1e-13);
    EXPECT_NEAR((m.centroid - Vec2{2.4, 3.2}).norm(), 0.0, 1e-14);
    // Steiner: 1 and 4 times pi at distances 4 and 1 from the centroid.
    EXPECT_NEAR(m.polar_moment, 0.5 * pi * (1.0 + 16.0) + pi * (16.0 + 4.0), 1e-12);
    EXPECT_EQ(boundary_curves(two).size(), 2U);
}

/// Two equal circles less their lens: area, and its polar moment from those of sector and triangle.
TEST(DiscUnion, TwoOverlappingDiscsAreTheirSumLessTheLens) {
    for (const double distance : {0.01, 0.6, 1.3, 1.999})
        for (const double turn : {0.0, 1.0, 3.5}) {
            const double half = std::acos(0.5 * distance), h = std::cos(half), b = std::sin(half);
            const double segment = half - h * b;
            const double about_circle = 0.5 * half - b * b * b * h / 6.0 - 0.5 * b * h * h * h;
            const double about_lens = about_circle - 2.0 * h * (2.0 / 3.0 * b * b * b) + h * h * segment;
            const Vec2 along{std::cos(turn), std::sin(turn)};
            const std::vector<Disc> two{{Vec2{5.0, 6.0} - 0.5 * distance * along, 1.0},
                                        {Vec2{5.0, 6.0} + 0.5 * distance * along, 1.0}};
            const UnionMoments m = union_moments(two);
            EXPECT_NEAR(m.area, 2.0 * (pi - segment), 1e-13);
            EXPECT_NEAR((m.centroid - Vec2{5.0, 6.0}).norm(), 0.0, 1e-14);
            EXPECT_NEAR(m.polar_moment, pi + 0.5 * pi * distance * distance - 2.0 * about_lens, 1e-12);
            EXPECT_EQ(boundary_curves(two).size(), 1U);
        }
}

/// Mid-points of a grid; what it misses is what the boundary does with the cells it cuts.
UnionMoments sampled(const std::vector<Disc>& discs) {
    constexpr int cells = 2400;
    const double side = 6.0 / cells;
    UnionMoments m;
    double second = 0.0;
    for (int i = 0; i < cells; ++i)
        for (int j = 0; j < cells; ++j) {
            const Vec2 x{-3.0 + (i + 0.5) * side, -3.0 + (j + 0.5) * side};
            bool inside = false;
            for (const Disc& d : discs) inside |= (x - d.center).squaredNorm() < d.radius * d.radius;
            if (!inside) continue;
            m.area += side * side;
            m.centroid += side * side * x;
            second += side * side * x.squaredNorm();
        }
    m.centroid /= m.area;
    m.polar_moment = second - m.area * m.centroid.squaredNorm();
    return m;
}

TEST(DiscUnion, ManyDiscsAsFineSamplingSees) {
    const std::vector<std::vector<Disc>> cases{
        {{{-0.7, 0.0}, 1.0}, {{0.8, 0.1}, 0.9}, {{0.1, 1.0}, 1.3}},                     // common to three
        {{{-1.0, -0.6}, 1.05}, {{1.0, -0.6}, 1.05}, {{0.0, 1.13}, 1.05}},               // around a hole
        {{{0.0, 0.0}, 2.0}, {{1.0, 0.2}, 0.5}, {{-1.9, 0.3}, 0.6}, {{2.2, 0.0}, 0.5}},  // one hidden
        {{{0.3, 0.4}, 1.0}, {{0.3, 0.4}, 1.0}, {{0.9, 0.4}, 1.0}},                      // one twice
    };
    for (std::size_t k = 0; k < cases.size(); ++k) {
        const UnionMoments exact = union_moments(cases[k]), near = sampled(cases[k]);
        EXPECT_NEAR(exact.area, near.area, 1e-4 * near.area) << k;
        EXPECT_NEAR((exact.centroid - near.centroid).norm(), 0.0, 1e-4) << k;
        EXPECT_NEAR(exact.polar_moment, near.polar_moment, 2e-4 * near.polar_moment) << k;
        EXPECT_EQ(boundary_curves(cases[k]).size(), k == 1 ? 2U : 1U) << k;
    }
}

TEST(ClumpShape, HasTheSizeOfTheUnitDisc) {
    const ClumpShape dimer = clump_shape(discs_in_line(2, 1.6));
    const UnionMoments m = union_moments(dimer.discs);
    EXPECT_NEAR(m.area, pi, 1e-14);
    EXPECT_NEAR(m.centroid.norm(), 0.0, 1e-15);
    EXPECT_NEAR(m.polar_moment, dimer.polar_moment, 1e-14);
    EXPECT_NEAR(dimer.reach, 1.6 * dimer.discs[0].radius, 1e-14);  // half of the length
    const Shape polygon = polygon_shape(dimer.outline);
    EXPECT_LT(polygon.area, pi);
    EXPECT_GT(polygon.area, 0.99 * pi);  // 48 nodes on a circle: 0.3 % less
    EXPECT_NEAR(clump_shape(discs_in_line(3, 2.0)).reach / clump_shape(discs_in_line(3, 2.0)).discs[0].radius,
                2.0, 1e-14);
}

TEST(ClumpShape, SaysWhatIsWrong) {
    const auto fault = [](std::vector<Disc> discs) { return clump_fault(discs); };
    EXPECT_EQ(fault({{{0.0, 0.0}, 1.0}, {{1.0, 0.0}, 0.8}}), "");
    EXPECT_NE(fault({{{0.0, 0.0}, 1.0}, {{2.1, 0.0}, 1.0}}).find("one piece"), std::string::npos);
    EXPECT_NE(fault({{{-1.0, -0.6}, 1.05}, {{1.0, -0.6}, 1.05}, {{0.0, 1.13}, 1.05}}).find("without holes"),
              std::string::npos);
    EXPECT_NE(fault({{{0.0, 0.0}, 1.0}, {{0.1, 0.0}, 0.5}}).find("disc 1 inside"), std::string::npos);
    EXPECT_NE(fault({{{0.0, 0.0}, 0.0}}).find("disc 0"), std::string::npos);
    EXPECT_NE(fault({{{NAN, 0.0}, 1.0}}).find("disc 0"), std::string::npos);
    EXPECT_NE(fault(std::vector<Disc>(65, {{0.0, 0.0}, 1.0})).find("1 to 64"), std::string::npos);
}

TEST(ClumpKeys, ReadAndWrittenAlike) {
    const Scenario s = parse(std::string("[[grain_class]]\nclump_discs = 3\nclump_elongation = 2\n"
                                         "[[grain_class]]\nclump = \" 0 0 1,1.5 -.25  0.75\"\n"
                                         "[[grain_class]]\nclump_discs = 2\n[[grain_class]]\n") +
                             std::string(stage));
    ASSERT_TRUE(s.has_clumps());
    ASSERT_EQ(s.classes[0].clump.size(), 3U);
    EXPECT_EQ(s.classes[0].clump[2].center, Vec2(1.0, 0.0));
    EXPECT_EQ(s.classes[1].clump[1].center, Vec2(1.5, -0.25));
    EXPECT_EQ(s.classes[1].clump[1].radius, 0.75);
    EXPECT_EQ(s.classes[2].clump[1].center, Vec2(0.5, 0.0));
    EXPECT_TRUE(s.classes[3].clump.empty());
    const std::string written = write_scenario(s, {});
    const Scenario again = parse(written);
    for (std::size_t c = 0; c < 4; ++c) {
        ASSERT_EQ(again.classes[c].clump.size(), s.classes[c].clump.size());
        for (std::size_t d = 0; d < s.classes[c].clump.size(); ++d) {
            EXPECT_EQ(again.classes[c].clump[d].center, s.classes[c].clump[d].center);
            EXPECT_EQ(again.classes[c].clump[d].radius, s.classes[c].clump[d].radius);
        }
    }
}

TEST(ClumpKeys, MistakesHaveAPlaceAndACure) {
    const auto error = [](const std::string& keys) {
        return error_of("[[grain_class]]\n" + keys + std::string(stage));
    };
    EXPECT_EQ(error("clump = \"0 0 1, 1 0\"\n"),
              "s.toml:2:9: grain_class.0.clump must be a list \"x y r, x y r\", a disc between two commas");
    for (const char* bad : {"\"\"", "\"a\"", "\"0 0 1,\"", "\"0 0 1 2\"", "\"0 0 1;1 0 1\"", "\"0 0x 1\""})
        EXPECT_NE(error(std::string("clump = ") + bad + "\n").find("s.toml:2:9: grain_class.0.clump must be"),
                  std::string::npos)
            << bad;
    EXPECT_NE(error("clump = \"0 0 1, 3 0 1\"\n").find("s.toml:2:9: grain_class.0.clump must be one piece"),
              std::string::npos);
    EXPECT_EQ(error("clump = \"0 0 1\"\nclump_discs = 2\n"),
              "s.toml:3:15: grain_class.0.clump_discs and clump say the same: keep one");
    EXPECT_EQ(error("clump_discs = 2\nclump_elongation = 2.0\n"),
              "s.toml:3:20: grain_class.0.clump_elongation must be > 1 and < 2 so that 2 discs in a line "
              "overlap, got 2");
    EXPECT_NE(error("clump_elongation = 2.0\n").find("s.toml:2:20: grain_class.0.clump_elongation has no"),
              std::string::npos);
    EXPECT_NE(error("clump_discs = 2\naspect_ratio = 1.5\n").find("s.toml:3:16: grain_class.0.aspect_ratio"),
              std::string::npos);
    EXPECT_NE(error("clump_discs = 1\n").find("s.toml:2:15: grain_class.0.clump_discs must be >= 2"),
              std::string::npos);
}

Scenario of_clumps(Generator generator, bool periodic) {
    Scenario s;
    s.classes.resize(3);
    s.classes[0].clump = discs_in_line(2, 1.7);
    s.classes[1].clump = {{{0.0, 0.0}, 1.0}, {{1.1, 0.0}, 0.6}, {{0.0, 1.2}, 0.7}};
    s.packing.count = 40;
    s.packing.generator = generator;
    if (generator == Generator::random_sequential) s.packing.packing_fraction = 0.35;
    s.box.periodic = periodic;
    return s;
}

/// Every disc against every other of the nine cells around, and against the walls.
TEST(ClumpPacking, NoGeneratorLeavesAnOverlap) {
    for (const bool periodic : {false, true})
        for (const auto generator : {Generator::growth, Generator::random_sequential, Generator::compaction,
                                     Generator::geometric, Generator::deposition}) {
            if (periodic && generator != Generator::growth && generator != Generator::random_sequential)
                continue;
            const Packing p = make_packing(of_clumps(generator, periodic));
            double deepest = -1.0, area = 0.0;
            for (std::size_t i = 0; i < p.size(); ++i) {
                area += union_moments(p.discs_of(i)).area;
                for (const Disc& a : p.discs_of(i)) {
                    EXPECT_LE((a.center - p.center[i]).norm() + a.radius, p.reach(i) * (1.0 + 1e-14));
                    for (int w = 0; w < 4 && !periodic; ++w)
                        deepest = std::max(deepest, a.radius - p.box.distance(w, a.center));
                    for (std::size_t j = 0; j < i; ++j)
                        for (const Disc& b : p.discs_of(j))
                            for (int image = 0; image < (periodic ? 9 : 1); ++image) {
                                const Vec2 shift =
                                    periodic ? p.box.image(image % 3 - 1, image / 3 - 1) : Vec2::Zero();
                                deepest = std::max(
                                    deepest, a.radius + b.radius - (b.center + shift - a.center).norm());
                            }
                }
            }
            EXPECT_LE(deepest, 1e-12) << static_cast<int>(generator) << periodic;
            EXPECT_NEAR(area / p.box.area(), p.packing_fraction_undeformed(), 1e-13);
            if (generator == Generator::random_sequential) {
                EXPECT_NEAR(area / p.box.area(), 0.35, 1e-12);
            }
        }
}

TEST(ClumpPacking, ReadsBackFromAFile) {
    const auto path =
        std::filesystem::temp_directory_path() / ("clumps_" + std::to_string(getpid()) + ".csv");
    Scenario s = of_clumps(Generator::random_sequential, false);
    const Packing p = make_packing(s);
    write_packing_csv(path, p);
    s.packing.path = path;
    s.box.width = p.box.width();
    s.box.height = p.box.height();
    const Packing again = make_packing(s);
    EXPECT_EQ(again.angle, p.angle);
    EXPECT_EQ(again.radius, p.radius);
    EXPECT_EQ(again.grain_class, p.grain_class);
    EXPECT_EQ(again.center, p.center);
    ASSERT_EQ(again.clumps.size(), 3U);

    Packing pushed = p;  // the discs around two grains may overlap, their discs may not
    std::size_t i = 0;
    while (p.class_of(i) != 0) ++i;
    const std::size_t j = i == 0 ? 1 : 0;
    pushed.center[j] = pushed.center[i] + Vec2{0.3, 0.0};
    write_packing_csv(path, pushed);
    EXPECT_THROW(make_packing(s), InputError);
    EXPECT_GT(relative_overlap(pushed, i, j), 0.1);
    s.classes[0].clump.clear();
    s.classes[1].clump.clear();
    EXPECT_THROW(make_packing(s), InputError) << "a column angle without clumps or ellipses";
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace softgrain::test
