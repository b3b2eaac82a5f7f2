// The disc on its grid: quadrature, extended splines, the surface curve, what is coupled and in which order.
// Bands of 1e-12 and less are rounding of numbers of order 1, with about ten times the errors seen.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "common/errors.hpp"
#include "mpm/disc/cut_cell.hpp"
#include "mpm/disc/dissection.hpp"
#include "mpm/disc/quadratic_spline.hpp"
#include "mpm/disc/reference_disc.hpp"
#include "mpm/disc/stiffness_pattern.hpp"

namespace softgrain::mpm {
namespace {

constexpr double pi = std::numbers::pi;

using Real = long double;
struct Point {
    Real x, y;
};
Real cross(Point a, Point b) {
    return a.x * b.y - a.y * b.x;
}
Real sector(Point a, Point b) {
    return std::atan2(cross(a, b), a.x * b.x + a.y * b.y) / 2;
}
/// Signed area of the part of the triangle (0, a, b) in the unit disc.
Real triangle_in_disc(Point a, Point b) {
    const Point d{b.x - a.x, b.y - a.y};
    const Real length = d.x * d.x + d.y * d.y, half = (a.x * d.x + a.y * d.y) / length;
    const Real root = half * half - (a.x * a.x + a.y * a.y - 1) / length;
    if (root <= 0) return sector(a, b);
    const Real in = std::clamp(-half - std::sqrt(root), Real(0), Real(1)),
               out = std::clamp(-half + std::sqrt(root), Real(0), Real(1));
    const Point p{a.x + in * d.x, a.y + in * d.y}, q{a.x + out * d.x, a.y + out * d.y};
    return sector(a, p) + cross(p, q) / 2 + sector(q, b);
}
/// Area of the rectangle in the disc, by Green's theorem.
double covered(const Vec2& low, const Vec2& high) {
    const std::array<Point, 4> corner{
        {{low.x(), low.y()}, {high.x(), low.y()}, {high.x(), high.y()}, {low.x(), high.y()}}};
    Real sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += triangle_in_disc(corner[k], corner[(k + 1) % 4]);
    return static_cast<double>(sum);
}

/// Integrals of (x - m)^2, (x - m)(y - m), (y - m)^2 over the rectangle in the disc, m its middle: a midpoint
/// sum over x = sin(angle), exact over y.
std::array<double, 3> second_moments(const Vec2& low, const Vec2& high) {
    const int n = 400;
    const double a0 = std::asin(std::clamp(low.x(), -1.0, 1.0)),
                 a1 = std::asin(std::clamp(high.x(), -1.0, 1.0));
    const Vec2 middle = 0.5 * (low + high);
    std::array<double, 3> sum{};
    for (int k = 0; k < n; ++k) {
        const double angle = a0 + (k + 0.5) / n * (a1 - a0), s = std::cos(angle);
        const double y0 = std::clamp(low.y(), -s, s) - middle.y(),
                     y1 = std::clamp(high.y(), -s, s) - middle.y();
        const double dx = s * (a1 - a0) / n, x = std::sin(angle) - middle.x();
        sum[0] += dx * x * x * (y1 - y0);
        sum[1] += dx * x * (y1 * y1 - y0 * y0) / 2.0;
        sum[2] += dx * (y1 * y1 * y1 - y0 * y0 * y0) / 3.0;
    }
    return sum;
}
std::array<double, 3> second_moments(const std::vector<QuadraturePoint>& points, const Vec2& middle) {
    std::array<double, 3> sum{};
    for (const QuadraturePoint& q : points) {
        const Vec2 x = q.position - middle;
        sum[0] += q.weight * x.x() * x.x();
        sum[1] += q.weight * x.x() * x.y();
        sum[2] += q.weight * x.y() * x.y();
    }
    return sum;
}
double area_of(const std::vector<QuadraturePoint>& points) {
    double sum = 0.0;
    for (const QuadraturePoint& q : points) sum += q.weight;
    return sum;
}

/// In how many of its four corners, and through how many of its sides, a rectangle is in the disc.
std::pair<int, int> way_of_cutting(const Vec2& low, const Vec2& high) {
    const std::array<Vec2, 4> corner{low, Vec2{high.x(), low.y()}, high, Vec2{low.x(), high.y()}};
    int inside = 0, sides = 0;
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 &a = corner[k], &b = corner[(k + 1) % 4];
        const double least =
            (a - std::clamp(a.dot(a - b) / (a - b).squaredNorm(), 0.0, 1.0) * (a - b)).norm();
        inside += a.norm() < 1.0;
        sides += least < 1.0;
    }
    return {inside, sides};
}

void expect_good(const Vec2& low, const Vec2& high) {
    const auto points = quadrature_in_disc(low, high);
    // Pieces below 1e-12 of the rectangle are left out, up to five of them.
    EXPECT_NEAR(area_of(points), covered(low, high), 1e-14 + 5e-12 * (high - low).prod())
        << low.transpose() << ", " << high.transpose();
    for (const QuadraturePoint& q : points) {
        EXPECT_GT(q.weight, 0.0);
        EXPECT_LE(q.position.norm(), 1.0 + 1e-15);
        EXPECT_TRUE((q.position.array() >= low.array()).all());
        EXPECT_TRUE((q.position.array() <= high.array()).all());
    }
}

TEST(QuadratureInDisc, AFullCellHasGaussPointsExactForCubics) {
    const Vec2 low{-0.3, 0.1}, high{0.2, 0.5};
    const auto points = quadrature_in_disc(low, high);
    ASSERT_EQ(points.size(), 4U);
    double sum = 0.0;
    for (const QuadraturePoint& q : points)
        sum += q.weight * std::pow(q.position.x(), 3) * std::pow(q.position.y(), 3);
    const auto integral = [](double a, double b) { return (std::pow(b, 4) - std::pow(a, 4)) / 4.0; };
    EXPECT_NEAR(sum, integral(-0.3, 0.2) * integral(0.1, 0.5), 1e-18);
}

TEST(QuadratureInDisc, NothingOutside) {
    EXPECT_TRUE(quadrature_in_disc({0.8, 0.8}, {1.0, 1.0}).empty());
    EXPECT_TRUE(quadrature_in_disc({1.0, -0.5}, {1.5, 0.5}).empty());
    EXPECT_TRUE(quadrature_in_disc({-0.5, -2.0}, {0.5, -1.1}).empty());
}

TEST(QuadratureInDisc, RectanglesCutInEveryWay) {
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> place(-1.4, 1.4);
    std::map<std::pair<int, int>, int> seen;
    for (int k = 0; k < 20000; ++k) {
        const Vec2 a{place(random), place(random)}, b{place(random), place(random)};
        const Vec2 low = a.cwiseMin(b), high = a.cwiseMax(b);
        ++seen[way_of_cutting(low, high)];
        expect_good(low, high);
    }
    // Corners inside and sides that reach into the disc: (0, 0) is nothing, or all of the disc.
    for (const auto& way : {std::pair{0, 0},
                            {0, 1},
                            {0, 2},
                            {0, 3},
                            {0, 4},
                            {1, 2},
                            {1, 3},
                            {1, 4},
                            {2, 3},
                            {2, 4},
                            {3, 4},
                            {4, 4}})
        EXPECT_GE(seen[way], 5) << way.first << " corners, " << way.second << " sides";
    EXPECT_NEAR(area_of(quadrature_in_disc({-1.3, -1.2}, {1.1, 1.4})), pi, 1e-14);
}

TEST(QuadratureInDisc, CornersAndSidesOnTheCircle) {
    for (const double h : {0.2, 0.5, 1.0})
        for (int j = -6; j < 6; ++j)
            for (int i = -6; i < 6; ++i) expect_good({i * h, j * h}, {(i + 1) * h, (j + 1) * h});
    // (0.6, 0.8) is on the circle, and 1 - 1e-9 all but on it.
    for (const double off : {0.0, 1e-15, -1e-15, 1e-9, -1e-9, 1e-6}) {
        expect_good({0.6 + off, 0.8}, {0.7, 0.9});
        expect_good({0.5, 0.7}, {0.6 + off, 0.8});
        expect_good({0.5, 0.8 + off}, {0.6, 0.9});
        expect_good({-0.1, 1.0 - 1e-9 + off}, {0.1, 1.2});
        expect_good({-1.0 - off, -0.1}, {-0.9, 0.1});
    }
}

TEST(QuadratureInDisc, SecondMomentsOfCutCells) {
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const double h : {0.5, 0.25, 0.125}) {
        double worst = 0.0;
        for (int k = 0; k < 1500; ++k) {
            const double angle = 2.0 * pi * unit(random);
            const Vec2 low = Vec2{std::cos(angle), std::sin(angle)} - h * Vec2{unit(random), unit(random)};
            const Vec2 high = low + Vec2{h, h};
            const auto sum = second_moments(quadrature_in_disc(low, high), 0.5 * (low + high)),
                       exact = second_moments(low, high);
            for (std::size_t m = 0; m < 3; ++m) worst = std::max(worst, std::abs(sum[m] - exact[m]));
        }
        // Exact for straight cuts: what is left is of the order of the curvature, 0.011 to 0.013 h^5. The
        // moment of a whole cell is h^4/12.
        EXPECT_LT(worst, 0.02 * std::pow(h, 5)) << h;
    }
}

TEST(ReferenceDisc, RefusesCellsOutOfRange) {
    for (const int cells : {-3, 0, 1, 65}) EXPECT_THROW(ReferenceDisc{cells}, InputError) << cells;
    EXPECT_EQ(ReferenceDisc{64}.cells, 64);
    EXPECT_EQ(reference_disc(3), reference_disc(3));  // made once
}

/// Coefficients of the monomials up to second degree, in B-splines on a uniform grid: x^2 between the knots
/// a and b inside a spline has the coefficient a b = g^2 - h^2/4 (Marsden).
struct Monomial {
    const char* name;
    std::function<double(const Vec2&)> value;
    std::function<Vec2(const Vec2&)> gradient;
    std::function<double(const Vec2&, double)> coefficient;
};
const std::vector<Monomial>& monomials() {
    static const std::vector<Monomial> all{
        {"1", [](const Vec2&) { return 1.0; },
         [](const Vec2&) {
             return Vec2{0.0, 0.0};
         },
         [](const Vec2&, double) { return 1.0; }},
        {"x", [](const Vec2& X) { return X.x(); },
         [](const Vec2&) {
             return Vec2{1.0, 0.0};
         },
         [](const Vec2& g, double) { return g.x(); }},
        {"y", [](const Vec2& X) { return X.y(); },
         [](const Vec2&) {
             return Vec2{0.0, 1.0};
         },
         [](const Vec2& g, double) { return g.y(); }},
        {"xx", [](const Vec2& X) { return X.x() * X.x(); },
         [](const Vec2& X) {
             return Vec2{2.0 * X.x(), 0.0};
         },
         [](const Vec2& g, double h) { return g.x() * g.x() - 0.25 * h * h; }},
        {"xy", [](const Vec2& X) { return X.x() * X.y(); },
         [](const Vec2& X) {
             return Vec2{X.y(), X.x()};
         },
         [](const Vec2& g, double) { return g.x() * g.y(); }},
        {"yy", [](const Vec2& X) { return X.y() * X.y(); },
         [](const Vec2& X) {
             return Vec2{0.0, 2.0 * X.y()};
         },
         [](const Vec2& g, double h) { return g.y() * g.y() - 0.25 * h * h; }}};
    return all;
}

/// Value and slope of the quadratic B-spline around 0 of width 3.
std::pair<double, double> spline(double t) {
    const double d = std::abs(t), side = t < 0.0 ? -1.0 : 1.0;
    if (d <= 0.5) return {0.75 - t * t, -2.0 * t};
    if (d <= 1.5) return {0.5 * (1.5 - d) * (1.5 - d), side * (d - 1.5)};
    return {0.0, 0.0};
}

class Disc : public testing::TestWithParam<int> {
  protected:
    std::shared_ptr<const ReferenceDisc> disc_ = reference_disc(GetParam());
    double h_ = disc_->spacing();

    double sum(const ShapeRows& rows, std::size_t row, const std::vector<double>& coefficient) const {
        double s = 0.0;
        for (std::size_t k = 0; k < rows.nodes(row).size(); ++k)
            s += rows.values(row)[k] * coefficient[static_cast<std::size_t>(rows.nodes(row)[k])];
        return s;
    }
    std::vector<double> coefficients(const Monomial& m) const {
        std::vector<double> c;
        for (const Vec2& g : disc_->coordinate) c.push_back(m.coefficient(g, h_));
        return c;
    }
    Vec2 point(std::size_t p) const { return disc_->at_points.at(p, disc_->coordinate); }
    int node(const Cell& c, int a) const {
        return disc_->cell_node[static_cast<std::size_t>(c.first_node + a)];
    }
    const Vec2& gradient(const Cell& c, int p, int a) const {
        return disc_->gradient[static_cast<std::size_t>(c.first_gradient + p * c.nodes + a)];
    }
    /// Largest error of a monomial in rows of shape functions at given places.
    template <class Place>
    double error(const ShapeRows& rows, const Place& place) const {
        double worst = 0.0;
        for (const Monomial& m : monomials()) {
            const auto c = coefficients(m);
            for (std::size_t k = 0; k < rows.size(); ++k)
                worst = std::max(worst, std::abs(sum(rows, k, c) - m.value(place(k))));
        }
        return worst;
    }
};
INSTANTIATE_TEST_SUITE_P(Cells, Disc, testing::Range(2, 17));

TEST_P(Disc, WeightsSumToTheArea) {
    Real area = 0.0;
    for (const double w : disc_->weight) {
        EXPECT_GT(w, 0.0);
        area += w;
    }
    EXPECT_NEAR(static_cast<double>(area), pi, 1e-13);
    // Of N: the same sum in another order. None is negative: they are masses.
    Real of_nodes = 0.0;
    for (const double n : disc_->integral) {
        EXPECT_GT(n, 0.0);
        of_nodes += n;
    }
    EXPECT_NEAR(static_cast<double>(of_nodes), pi, 1e-13);
}

TEST_P(Disc, SecondMomentsOfTheArea) {
    std::array<double, 3> moment{};
    for (std::size_t p = 0; p < disc_->points(); ++p) {
        const Vec2 X = point(p);
        moment[0] += disc_->weight[p] * X.x() * X.x();
        moment[1] += disc_->weight[p] * X.x() * X.y();
        moment[2] += disc_->weight[p] * X.y() * X.y();
    }
    // Quadrature in the cells that are cut: 7e-4 for two cells, 3e-8 for 16, at most 0.027 h^4.
    const double band = 0.04 * std::pow(h_, 4);
    EXPECT_NEAR(moment[0], pi / 4.0, band);
    EXPECT_NEAR(moment[1], 0.0, 1e-15);  // by symmetry
    EXPECT_NEAR(moment[2], pi / 4.0, band);
}

TEST_P(Disc, PointsAreThoseOfTheCells) {
    std::set<std::pair<int, int>> met;
    Real area = 0.0;
    for (const Cell& c : disc_->cell) {
        const Vec2 at = point(static_cast<std::size_t>(c.first_point)) / h_;
        const int x = static_cast<int>(std::floor(at.x())), y = static_cast<int>(std::floor(at.y()));
        EXPECT_TRUE(met.insert({x, y}).second);
        const auto points = quadrature_in_disc({x * h_, y * h_}, {(x + 1) * h_, (y + 1) * h_});
        ASSERT_EQ(static_cast<std::size_t>(c.points), points.size());
        for (std::size_t p = 0; p < points.size(); ++p) {
            const std::size_t k = static_cast<std::size_t>(c.first_point) + p;
            EXPECT_LT((point(k) - points[p].position).norm(), 1e-14);
            EXPECT_EQ(disc_->weight[k], points[p].weight);
            area += points[p].weight;
            ASSERT_EQ(disc_->at_points.nodes(k).size(), static_cast<std::size_t>(c.nodes));
            for (int a = 0; a < c.nodes; ++a)
                EXPECT_EQ(disc_->at_points.nodes(k)[static_cast<std::size_t>(a)], node(c, a));
        }
    }
    EXPECT_NEAR(static_cast<double>(area), pi, 1e-13);  // so that none is missing
}

TEST_P(Disc, QuadraticFieldsAreExactAtPointsAndOnTheSurface) {
    // One of them is 1: partition of unity. Extrapolation has factors up to 6, and points to 1.3 spacings.
    EXPECT_LT(error(disc_->at_points, [&](std::size_t p) { return point(p); }), 1e-13);
    const auto angle = [](std::size_t k, std::size_t n) {
        return 2.0 * pi * (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    };
    const std::size_t points = disc_->surface.size(), controls = disc_->control.size();
    EXPECT_LT(error(disc_->surface,
                    [&](std::size_t k) {
                        return Vec2{std::cos(angle(k, points)), std::sin(angle(k, points))};
                    }),
              1e-13);
    // Control points lie outside so that the curve touches the circle between its knots.
    const double radius = 4.0 / (3.0 + std::cos(2.0 * pi / static_cast<double>(controls)));
    EXPECT_LT(error(disc_->control,
                    [&](std::size_t k) -> Vec2 {
                        return radius * Vec2{std::cos(angle(k, controls)), std::sin(angle(k, controls))};
                    }),
              1e-13);
    EXPECT_EQ(controls % 8, 0U);
    EXPECT_DOUBLE_EQ(disc_->surface_weight() * static_cast<double>(points), 2.0 * pi);
}

TEST_P(Disc, GradientsOfQuadraticFieldsAreExact) {
    for (const Monomial& m : monomials()) {
        const auto coefficient = coefficients(m);
        double worst = 0.0;
        for (const Cell& c : disc_->cell)
            for (int p = 0; p < c.points; ++p) {
                Vec2 sum = Vec2::Zero();
                for (int a = 0; a < c.nodes; ++a)
                    sum += coefficient[static_cast<std::size_t>(node(c, a))] * gradient(c, p, a);
                const Vec2 X = point(static_cast<std::size_t>(c.first_point + p));
                worst = std::max(worst, (sum - m.gradient(X)).norm());
            }
        EXPECT_LT(worst, 1e-12) << m.name;
    }
}

TEST_P(Disc, GradientsAreDifferencesOfValues) {
    // Along a side of a cell N is a parabola: the mean of two slopes is the difference.
    int pairs = 0;
    double worst = 0.0;
    for (const Cell& c : disc_->cell)
        for (int p = 0; p < c.points; ++p)
            for (int q = 0; q < p; ++q) {
                const auto i = static_cast<std::size_t>(c.first_point + p),
                           j = static_cast<std::size_t>(c.first_point + q);
                const Vec2 apart = point(i) - point(j);
                if (apart.cwiseAbs().minCoeff() > 1e-14) continue;
                ++pairs;
                for (int a = 0; a < c.nodes; ++a) {
                    const auto k = static_cast<std::size_t>(a);
                    const double difference = disc_->at_points.values(i)[k] - disc_->at_points.values(j)[k];
                    const double mean = 0.5 * (gradient(c, p, a) + gradient(c, q, a)).dot(apart);
                    worst = std::max(worst, std::abs(difference - mean));
                }
            }
    EXPECT_LT(worst, 1e-13);
    EXPECT_GE(pairs, static_cast<int>(disc_->points()) / 2);  // at least its partner in the column
}

TEST_P(Disc, SplinesInsideAreSplines) {
    int cells = 0;
    for (const Cell& c : disc_->cell) {
        if (c.nodes != 9) continue;
        const Vec2 at = point(static_cast<std::size_t>(c.first_point)) / h_;
        const Vec2 middle{std::floor(at.x()) + 0.5, std::floor(at.y()) + 0.5};
        bool own = true;
        for (int a = 0; a < 9; ++a)
            own = own && (disc_->coordinate[static_cast<std::size_t>(node(c, a))] / h_ - middle)
                                 .cwiseAbs()
                                 .maxCoeff() < 1.1;
        if (!own) continue;
        ++cells;
        for (int p = 0; p < c.points; ++p)
            for (int a = 0; a < 9; ++a) {
                const auto k = static_cast<std::size_t>(c.first_point + p);
                const Vec2 t = (point(k) - disc_->coordinate[static_cast<std::size_t>(node(c, a))]) / h_;
                const auto [Nx, dx] = spline(t.x());
                const auto [Ny, dy] = spline(t.y());
                EXPECT_NEAR(disc_->at_points.values(k)[static_cast<std::size_t>(a)], Nx * Ny, 1e-14);
                EXPECT_LT((gradient(c, p, a) - Vec2{dx * Ny, Nx * dy} / h_).norm(), 1e-12);
            }
    }
    // All but the cells along the circle, and those beside them.
    EXPECT_GE(cells, 4 * (GetParam() - 1) * (GetParam() - 1) / 2);
}

TEST_P(Disc, ClosedCurveFollowsTheCircle) {
    // It touches the circle in the middle of each span; at the knots it is inside by a^4/8, a = pi/controls:
    // 1.2e-7 for 100 controls.
    const std::size_t n = disc_->control.size();
    const double inside = std::pow(pi / static_cast<double>(n), 4) / 8.0;
    double deepest = 0.0, highest = 0.0;
    for (std::size_t k = 0; k < n; ++k)
        for (int s = 0; s <= 20; ++s) {
            const SplineSpan N = spline_span(s / 20.0);
            Vec2 x = Vec2::Zero();
            for (std::size_t a = 0; a < 3; ++a)
                x += N.value[a] * disc_->control.at((k + a) % n, disc_->coordinate);
            deepest = std::max(deepest, 1.0 - x.norm());
            highest = std::max(highest, x.norm() - 1.0);
        }
    EXPECT_NEAR(deepest, inside, 0.01 * inside);  // next term: a^2
    EXPECT_LT(highest, 1e-15);
    EXPECT_GE(static_cast<double>(n),
              4.0 * pi * GetParam());  // two a cell: 16 times less for twice the cells
}

TEST_P(Disc, IsSymmetric) {
    const auto key = [&](const Vec2& x) {
        return std::pair{std::lround(2.0 * x.x() / h_), std::lround(2.0 * x.y() / h_)};
    };
    std::map<std::pair<long, long>, int> node_at;
    for (std::size_t m = 0; m < disc_->nodes(); ++m) node_at[key(disc_->coordinate[m])] = static_cast<int>(m);
    ASSERT_EQ(node_at.size(), disc_->nodes());
    std::vector<std::size_t> turned, mirrored;
    for (const Vec2& x : disc_->coordinate) {
        ASSERT_EQ(node_at.count(key({-x.y(), x.x()})), 1U) << x.transpose();
        ASSERT_EQ(node_at.count(key({x.x(), -x.y()})), 1U) << x.transpose();
        turned.push_back(static_cast<std::size_t>(node_at[key({-x.y(), x.x()})]));
        mirrored.push_back(static_cast<std::size_t>(node_at[key({x.x(), -x.y()})]));
    }
    const auto dense = [&](const ShapeRows& rows, std::size_t row) {
        std::vector<double> values(disc_->nodes(), 0.0);
        for (std::size_t k = 0; k < rows.nodes(row).size(); ++k)
            values[static_cast<std::size_t>(rows.nodes(row)[k])] = rows.values(row)[k];
        return values;
    };
    double worst = 0.0;
    for (const ShapeRows* rows : {&disc_->surface, &disc_->control}) {
        const std::size_t n = rows->size();
        for (std::size_t k = 0; k < n; ++k) {
            const auto here = dense(*rows, k), quarter = dense(*rows, (k + n / 4) % n),
                       mirror = dense(*rows, n - 1 - k);
            for (std::size_t m = 0; m < disc_->nodes(); ++m)
                worst = std::max(
                    {worst, std::abs(quarter[turned[m]] - here[m]), std::abs(mirror[mirrored[m]] - here[m])});
        }
    }
    EXPECT_LT(worst, 1e-13);
}

TEST_P(Disc, EveryPairOfACellHasItsPlace) {
    const StiffnessPattern pattern(*disc_);
    ASSERT_EQ(pattern.start.size(), disc_->nodes() + 1);
    ASSERT_EQ(pattern.cell_start.size(), disc_->cell.size());
    EXPECT_EQ(pattern.start.front(), 0);
    EXPECT_EQ(static_cast<std::size_t>(pattern.start.back()), pattern.size());
    for (std::size_t m = 0; m < disc_->nodes(); ++m) {
        const auto first = pattern.column.begin() + pattern.start[m],
                   last = pattern.column.begin() + pattern.start[m + 1];
        EXPECT_TRUE(std::is_sorted(first, last, std::less_equal<>()));
        ASSERT_NE(first, last);
        EXPECT_EQ(*(last - 1), static_cast<int>(m));
    }
    std::vector<char> used(pattern.size(), 0);
    for (std::size_t k = 0; k < disc_->cell.size(); ++k) {
        const Cell& c = disc_->cell[k];
        int place = pattern.cell_start[k];
        for (int a = 0; a < c.nodes; ++a)
            for (int b = 0; b <= a; ++b) {
                const int at = pattern.place[static_cast<std::size_t>(place++)];
                const auto row = static_cast<std::size_t>(node(c, a));
                EXPECT_GE(at, pattern.start[row]);
                EXPECT_LT(at, pattern.start[row + 1]);
                EXPECT_EQ(pattern.column[static_cast<std::size_t>(at)], node(c, b));
                used[static_cast<std::size_t>(at)] = 1;
            }
    }
    EXPECT_EQ(std::count(used.begin(), used.end(), 1), static_cast<std::ptrdiff_t>(pattern.size()));
}

TEST_P(Disc, RegionsAreCoupledOnlyWithThoseAboveAndBelow) {
    const StiffnessPattern pattern(*disc_);
    const Dissection dissection(*disc_, pattern);
    std::vector<int> region_of(disc_->nodes(), -1);
    for (std::size_t r = 0; r < dissection.region.size(); ++r) {
        const auto& region = dissection.region[r];
        EXPECT_EQ(region.parent == -1, r + 1 == dissection.region.size());
        if (region.parent >= 0) {
            EXPECT_GT(region.parent, static_cast<int>(r));
        }
        EXPECT_TRUE(std::is_sorted(region.nodes.begin(), region.nodes.end(), std::less_equal<>()));
        for (const int m : region.nodes) {
            EXPECT_EQ(region_of[static_cast<std::size_t>(m)], -1);
            region_of[static_cast<std::size_t>(m)] = static_cast<int>(r);
        }
    }
    EXPECT_EQ(std::count(region_of.begin(), region_of.end(), -1), 0);
    const auto is_above = [&](int above, int r) {
        while (r >= 0 && r != above) r = dissection.region[static_cast<std::size_t>(r)].parent;
        return r == above;
    };
    std::set<std::array<int, 4>> expected;
    for (int m = 0; m < static_cast<int>(disc_->nodes()); ++m)
        for (int k = pattern.start[static_cast<std::size_t>(m)];
             k < pattern.start[static_cast<std::size_t>(m) + 1]; ++k) {
            const int n = pattern.column[static_cast<std::size_t>(k)];
            expected.insert({m, n, k, 0});
            if (n != m) expected.insert({n, m, k, 1});
            const int r = region_of[static_cast<std::size_t>(m)], s = region_of[static_cast<std::size_t>(n)];
            EXPECT_TRUE(is_above(r, s) || is_above(s, r)) << m << ", " << n;
        }
    std::size_t couplings = 0;
    for (int m = 0; m < static_cast<int>(disc_->nodes()); ++m) {
        const auto& coupled = dissection.coupled[static_cast<std::size_t>(m)];
        couplings += coupled.size();
        for (std::size_t k = 0; k < coupled.size(); ++k) {
            EXPECT_EQ(expected.count({m, coupled[k].node, coupled[k].place, coupled[k].transposed}), 1U);
            if (k > 0) {
                EXPECT_LT(coupled[k - 1].node, coupled[k].node);
            }
        }
    }
    EXPECT_EQ(couplings, expected.size());
    if (disc_->nodes() > 24U) {
        EXPECT_GE(dissection.region.size(), 3U);  // it divides
    }
}

}  // namespace
}  // namespace softgrain::mpm
