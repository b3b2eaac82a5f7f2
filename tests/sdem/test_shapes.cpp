// Caps, wall contacts and the ellipse cut by its chords.
#include <gtest/gtest.h>

#include <numbers>

#include "random_ellipses.hpp"
#include "sdem/geometry/chord.hpp"
#include "sdem/geometry/clipped_ellipse.hpp"
#include "sdem/geometry/wall_chord.hpp"

namespace softgrain::sdem {
namespace {

constexpr double pi = std::numbers::pi;

TEST(UnitCap, MatchesLongDoubleForEveryOpening) {
    for (double q = 1e-7; q < 50.0; q *= 1.07) {
        // psi - sin(psi) cos(psi) = integral of 2 sin^2: the small end from its own expansion in psi.
        const long double psi = 2.0L * std::atan(static_cast<long double>(q)), p2 = psi * psi;
        const long double expected =
            psi < 0.1L ? psi * p2 *
                             (2.0L / 3 -
                              p2 * (2.0L / 15 - p2 * (4.0L / 315 - p2 * (2.0L / 2835 - p2 * 4.0L / 155925))))
                       : psi - std::sin(psi) * std::cos(psi);
        EXPECT_NEAR(unit_cap(q).area / static_cast<double>(expected), 1.0, 2e-14) << "q " << q;
        EXPECT_NEAR(unit_cap(q).half_angle / static_cast<double>(psi), 1.0, 1e-15) << "q " << q;
    }
    EXPECT_NEAR(unit_cap(1.0).area, 0.5 * pi, 1e-15);
}

TEST(WallChord, AgainstLongDouble) {
    std::mt19937_64 random(9);
    for (double depth : {0.3, 0.1, 1e-3, 1e-6, 1e-9}) {
        const double tolerance = std::max(1e-13, 2e-15 / depth);
        for (int k = 0; k < 200; ++k) {
            const Ellipse e = make_ellipse(Vec2{0.4, -0.2}, test::random_F(random, 0.4), 0.7);
            const Vec2 inward = test::rotation(0.0311 * k) * Vec2{1.0, 0.0};
            const test::LongEllipse exact(e);
            const double distance = static_cast<double>(exact.support(inward.x(), inward.y())) - depth;
            const WallChord c = wall_chord(e, inward, distance);
            ASSERT_TRUE(c.touching);
            const test::Real support = exact.support(inward.x(), inward.y());
            const test::Real cosine = distance / support, sine = std::sqrt((1 - cosine) * (1 + cosine));
            const test::Real psi = std::atan2(sine, cosine);
            EXPECT_NEAR(c.depth, static_cast<double>(support - distance), tolerance * depth);
            EXPECT_NEAR(c.length / static_cast<double>(2 * sine * exact.det() / support), 1.0, tolerance);
            EXPECT_NEAR(c.cap / static_cast<double>(exact.det() * (psi - std::sin(2 * psi) / 2)), 1.0,
                        2.0 * tolerance + 1e-19 / std::pow(depth, 1.5));
            // The chord lies on the wall and ends on the outline.
            EXPECT_NEAR(inward.dot(c.point - e.center), -distance, 1e-14);
            for (double side : {-0.5, 0.5}) {
                const Vec2 end = c.point + side * c.length * perpendicular(inward);
                EXPECT_NEAR((e.inverse * (end - e.center)).norm(), 1.0, 1e-13);
            }
        }
    }
}

TEST(WallChord, ApartBeyondAndEscaped) {
    const Ellipse e = make_ellipse(Vec2::Zero(), Mat2::Identity(), 1.0);
    const Vec2 inward{1.0, 0.0};
    EXPECT_FALSE(wall_chord(e, inward, 1.0).touching);
    const WallChord half = wall_chord(e, inward, 0.0);
    EXPECT_NEAR(half.cap, 0.5 * pi, 1e-15);
    EXPECT_NEAR(half.length, 2.0, 1e-15);
    const WallChord most = wall_chord(e, inward, -0.5);
    EXPECT_NEAR(most.cap, pi - (pi / 3.0 - std::sqrt(3.0) / 4.0), 1e-14);
    EXPECT_TRUE(wall_chord(e, inward, -1.0).escaped);
}

double polygon_area(const std::vector<Vec2>& p) {
    double twice = 0.0;
    for (std::size_t k = 0; k < p.size(); ++k) twice += cross(p[k], p[(k + 1) % p.size()]);
    return 0.5 * twice;
}

/// Area below all cuts by strips of the unit disc along x: exact bounds in y, midpoint rule in x.
double area_by_strips(const Ellipse& e, const std::vector<Cut>& cuts, int strips) {
    double sum = 0.0;
    for (int k = 0; k < strips; ++k) {
        // x = sin(t) makes the integrand smooth at both ends; steep cuts leave an error of order 1/strips^2
        // to 1/strips.
        const double t = -0.5 * pi + pi * (k + 0.5) / strips;
        const double x = std::sin(t);
        double low = -std::cos(t), high = std::cos(t);
        for (const Cut& cut : cuts) {
            const double room = cut.distance - cut.direction.x() * x;
            if (cut.direction.y() > 0.0)
                high = std::min(high, room / cut.direction.y());
            else
                low = std::max(low, room / cut.direction.y());
        }
        sum += std::max(0.0, high - low) * std::cos(t) * pi / strips;
    }
    return e.det * sum;
}

std::vector<Cut> random_cuts(std::mt19937_64& random, int count) {
    std::uniform_real_distribution<double> angle(-pi, pi), distance(0.3, 1.1);
    std::vector<Cut> cuts;
    for (int k = 0; k < count; ++k) {
        const double a = angle(random);
        cuts.push_back({Vec2{std::cos(a), std::sin(a)}, distance(random)});
    }
    return cuts;
}

TEST(ClippedEllipse, AreaAgainstStripsAndOutline) {
    std::mt19937_64 random(21);
    for (int k = 0; k < 300; ++k) {
        const Ellipse e = make_ellipse(Vec2{3.0, 1.0}, test::random_F(random, 0.3), 0.8);
        const std::vector<Cut> cuts = random_cuts(random, k % 9);
        const double area = clipped_area(e, cuts);
        EXPECT_NEAR(area, area_by_strips(e, cuts, 8000), 1e-5 * e.det);
        std::vector<Vec2> outline;
        append_clipped_outline(e, cuts, 2000, outline);
        // Inscribed polygon: short by at most 2/3 pi^3/n^2 of det.
        EXPECT_LE(polygon_area(outline), area + 1e-12);
        EXPECT_NEAR(polygon_area(outline), area, 21.0 / 4e6 * e.det);
        for (const Vec2& x : outline)
            for (const Cut& cut : cuts)
                EXPECT_LE(cut.direction.dot(e.inverse * (x - e.center)), cut.distance + 1e-12);
    }
}

TEST(ClippedEllipse, SeparateCapsAreSubtracted) {
    const Ellipse e =
        make_ellipse(Vec2::Zero(), test::rotation(0.4) * Vec2{1.2, 0.9}.asDiagonal().toDenseMatrix(), 2.0);
    const WallChord right = wall_chord(e, Vec2{-1.0, 0.0}, 2.0), left = wall_chord(e, Vec2{1.0, 0.0}, 1.9);
    const std::vector<Cut> cuts{cut_of(e, Vec2{1.0, 0.0}, right.point),
                                cut_of(e, Vec2{-1.0, 0.0}, left.point)};
    EXPECT_NEAR(clipped_area(e, cuts), pi * e.det - right.cap - left.cap, 1e-13);
}

TEST(ClippedEllipse, SpecialCases) {
    const Ellipse e = make_ellipse(Vec2::Zero(), Mat2::Identity(), 1.0);
    EXPECT_NEAR(clipped_area(e, {}), pi, 1e-15);
    const Vec2 x{1.0, 0.0};
    const std::vector<Cut> twice{{x, 0.5}, {x, 0.5}}, behind{{x, 0.5}, {x, 0.7}};
    const double expected = pi - (pi / 3.0 - std::sqrt(3.0) / 4.0);
    EXPECT_NEAR(clipped_area(e, twice), expected, 1e-14);
    EXPECT_NEAR(clipped_area(e, behind), expected, 1e-14);
    const std::vector<Cut> nothing_left{{x, -0.2}, {-x, -0.2}}, gone{{x, -1.0}};
    EXPECT_EQ(clipped_area(e, nothing_left), 0.0);
    EXPECT_EQ(clipped_area(e, gone), 0.0);
    // A square inside the circle: all arcs gone.
    std::vector<Cut> square;
    for (int k = 0; k < 4; ++k) square.push_back({test::rotation(0.5 * pi * k + 0.3) * x, 0.6});
    EXPECT_NEAR(clipped_area(e, square), 1.44, 1e-14);
}

TEST(ClippedEllipse, TwoGrainsCoverTheirUnion) {
    const Ellipse i = make_ellipse(Vec2::Zero(), Mat2::Identity(), 1.0);
    const Ellipse j = make_ellipse(Vec2{1.5, 0.2}, Mat2::Identity(), 0.8);
    WarmStart deepest;
    const Chord c = chord_of(i, j, deepest);
    const double d = j.center.norm(), r = 0.8;
    const double a = std::acos((d * d + 1.0 - r * r) / (2.0 * d)),
                 b = std::acos((d * d + r * r - 1.0) / (2.0 * d * r));
    const double lens = a - std::sin(a) * std::cos(a) + r * r * (b - std::sin(b) * std::cos(b));
    const std::vector<Cut> cut_i{cut_of(i, c.normal, c.point)}, cut_j{cut_of(j, -c.normal, c.point)};
    EXPECT_NEAR(clipped_area(i, cut_i) + clipped_area(j, cut_j), pi * (1.0 + r * r) - lens, 1e-13);
}

}  // namespace
}  // namespace softgrain::sdem
