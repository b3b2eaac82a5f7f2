#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/observables/shape.hpp"

namespace softgrain {
namespace {

constexpr double pi = std::numbers::pi;

/// Turned by `angle`, then moved.
std::vector<Vec2> placed(const std::vector<Vec2>& polygon, double angle, const Vec2& move) {
    std::vector<Vec2> result;
    for (const Vec2& p : polygon)
        result.push_back(move + std::cos(angle) * p + std::sin(angle) * perpendicular(p));
    return result;
}

std::vector<Vec2> ellipse(double a, double b, int corners) {
    std::vector<Vec2> polygon;
    for (int k = 0; k < corners; ++k) {
        const double t = 2.0 * pi * k / corners;
        polygon.emplace_back(a * std::cos(t), b * std::sin(t));
    }
    return polygon;
}

// Semi-axes 3 and 2, far from the origin. An inscribed polygon has less area by 1 - sin(x)/x = 4.1e-5 with
// x = 2 pi / 400; it is the affine image of a regular one, so its ratios are those of the ellipse.
TEST(Shape, EllipseHasItsAxes) {
    const Shape shape = polygon_shape(placed(ellipse(3.0, 2.0, 400), 0.4, {1000.0, -500.0}));
    EXPECT_NEAR(shape.area, 6.0 * pi, 4.2e-5 * 6.0 * pi);
    EXPECT_NEAR(shape.aspect_ratio, 1.5, 1e-9);
    EXPECT_NEAR(shape.orientation, 0.4, 1e-9);
    // Of a regular polygon 4e-10.
    EXPECT_NEAR(shape.asphericity, (1.5 + 1.0 / 1.5) / 2.0 - 1.0, 1e-8);
    EXPECT_NEAR(shape.perimeter, 15.865439589, 1e-3);  // complete elliptic integral: 12 E(5/9)
    EXPECT_NEAR(shape.circularity, 4.0 * pi * 6.0 * pi / (15.865439589 * 15.865439589), 1e-4);
}

TEST(Shape, SquareAndRectangle) {
    const std::vector<Vec2> square{{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    Shape shape = polygon_shape(placed(square, 0.7, {-3.0, 5.0}));
    EXPECT_NEAR(shape.area, 4.0, 1e-13);
    EXPECT_NEAR(shape.perimeter, 8.0, 1e-13);
    EXPECT_NEAR(shape.aspect_ratio, 1.0, 1e-7);  // the root of rounding
    EXPECT_NEAR(shape.asphericity, pi / 3.0 - 1.0, 1e-13);
    EXPECT_NEAR(shape.circularity, pi / 4.0, 1e-13);
    shape = polygon_shape(std::vector<Vec2>{{0, 0}, {0, 6}, {-2, 6}, {-2, 0}});
    EXPECT_NEAR(shape.aspect_ratio, 3.0, 1e-13);
    EXPECT_NEAR(std::abs(shape.orientation), pi / 2.0, 1e-13);
    // J = A (w^2 + h^2) / 12.
    EXPECT_NEAR(shape.asphericity, 2.0 * pi * 12.0 * (4.0 + 36.0) / 12.0 / 144.0 - 1.0, 1e-13);
}

TEST(Shape, TheOtherWayRoundOnlyTheAreaChangesItsSign) {
    std::vector<Vec2> polygon{{0, 0}, {3, 0}, {3.5, 1}, {1, 2}};
    const Shape there = polygon_shape(polygon);
    std::reverse(polygon.begin(), polygon.end());
    const Shape back = polygon_shape(polygon);
    EXPECT_NEAR(back.area, -there.area, 1e-14);
    EXPECT_NEAR(back.aspect_ratio, there.aspect_ratio, 1e-13);
    EXPECT_NEAR(back.orientation, there.orientation, 1e-13);
    EXPECT_NEAR(back.asphericity, there.asphericity, 1e-13);
    EXPECT_NEAR(back.circularity, there.circularity, 1e-13);
}

/// Teeth of 5 % around a circle, as the discs of an aggregate: the moments hardly see them, the perimeter
/// does.
TEST(Shape, RoughnessChangesThePerimeterOnly) {
    const int teeth = 40;
    const double low = 0.975, high = 1.025, step = pi / teeth;
    std::vector<Vec2> polygon;
    for (int k = 0; k < 2 * teeth; ++k) {
        const double radius = k % 2 == 0 ? high : low;
        polygon.emplace_back(radius * std::cos(k * step), radius * std::sin(k * step));
    }
    const Shape shape = polygon_shape(polygon);
    // Triangles to the centre: area low high sin(step) / 2 each, J = area (low^2 + high^2 + low high cos)
    // / 6.
    const double moment = low * low + high * high + low * high * std::cos(step);
    EXPECT_NEAR(shape.asphericity, 2.0 * pi * moment / (6.0 * teeth * low * high * std::sin(step)) - 1.0,
                1e-12);
    EXPECT_NEAR(shape.perimeter,
                2 * teeth * std::sqrt(low * low + high * high - 2.0 * low * high * std::cos(step)), 1e-12);
    EXPECT_LT(shape.asphericity, 0.002);
    EXPECT_LT(shape.circularity, 0.8);
    EXPECT_NEAR(shape.aspect_ratio, 1.0, 1e-7);
}

TEST(Shape, NoAreaIsADisc) {
    for (const auto& polygon : {std::vector<Vec2>{}, std::vector<Vec2>{{0, 0}, {1, 1}},
                                std::vector<Vec2>{{0, 0}, {1, 1}, {2, 2}, {3, 3}}}) {
        const Shape shape = polygon_shape(polygon);
        EXPECT_EQ(shape.aspect_ratio, 1.0);
        EXPECT_EQ(shape.orientation, 0.0);
        EXPECT_EQ(shape.asphericity, 0.0);
        EXPECT_EQ(shape.circularity, 1.0);
    }
}

TEST(Shape, EveryGrainHasOne) {
    std::vector<Vec2> points{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const auto narrow = placed(ellipse(2.0, 1.0, 100), 0.0, {5.0, 5.0});
    points.insert(points.end(), narrow.begin(), narrow.end());
    const std::vector<int> offset{0, 4, 104};
    GrainView view;
    EXPECT_TRUE(grain_shapes(view).empty());
    view.outline_offset = offset;
    view.outline_point = points;
    const std::vector<Shape> shapes = grain_shapes(view);
    ASSERT_EQ(shapes.size(), 2U);
    EXPECT_NEAR(shapes[0].area, 1.0, 1e-14);
    EXPECT_NEAR(shapes[1].aspect_ratio, 2.0, 1e-12);
}

}  // namespace
}  // namespace softgrain
