#pragma once
// The alpha complex of discs by brute force: an oracle for the outline, slow and independent of it.
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "common/vec.hpp"

namespace softgrain::bpm {

struct AlphaComplex {
    std::vector<std::array<int, 3>> triangles;
    double triangle_area = 0.0;
    double discs_outside = 0.0;  ///< area of the discs' sectors in no triangle
    double area() const { return triangle_area + discs_outside; }
};

/// Circle orthogonal to three circles with these centres and squared radii.
struct OrthogonalCircle {
    Vec2 centre;
    double square;  ///< squared radius, negative if the circle is imaginary
    OrthogonalCircle(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& squares_bc, double square_a) {
        Mat2 rows;
        rows << 2.0 * (b - a).transpose(), 2.0 * (c - a).transpose();
        const Vec2 right{(b - a).squaredNorm() - squares_bc[0] + square_a,
                         (c - a).squaredNorm() - squares_bc[1] + square_a};
        const Vec2 from_a = rows.inverse() * right;
        centre = a + from_a;
        square = from_a.squaredNorm() - square_a;
    }
};

/// The triangles of the weighted Delaunay triangulation with weights (r + rho)^2 whose orthogonal circle has
/// a negative square: three discs are such a triangle if no other has a smaller power than they at the
/// circle's centre.
inline AlphaComplex alpha_complex(std::span<const Vec2> x, std::span<const double> radius, double rho) {
    const auto n = static_cast<int>(x.size());
    const auto at = [](int k) { return static_cast<std::size_t>(k); };
    const auto weight = [&](int k) { return (radius[at(k)] + rho) * (radius[at(k)] + rho); };
    std::vector<std::vector<int>> near(at(n));  // grown discs that overlap: others make no solid triangle
    for (int i = 0; i < n; ++i)
        for (int j = i + 1; j < n; ++j)
            if ((x[at(j)] - x[at(i)]).norm() < radius[at(i)] + radius[at(j)] + 2.0 * rho)
                near[at(i)].push_back(j);

    AlphaComplex result;
    std::vector<double> turned(at(n), 0.0);  // sum of the angles of a disc's triangles
    const auto add = [&](std::array<int, 3> t) {
        result.triangles.push_back(t);
        for (int k = 0; k < 3; ++k) {
            const Vec2& here = x[at(t[at(k)])];
            const Vec2 a = x[at(t[at((k + 1) % 3)])] - here;
            const Vec2 b = x[at(t[at((k + 2) % 3)])] - here;
            turned[at(t[at(k)])] += std::abs(std::atan2(cross(a, b), a.dot(b)));
            if (k == 0) result.triangle_area += 0.5 * std::abs(cross(a, b));
        }
    };
    for (int i = 0; i < n; ++i)
        for (const int j : near[at(i)])
            for (const int k : near[at(j)]) {
                const OrthogonalCircle circle(x[at(i)], x[at(j)], x[at(k)], {weight(j), weight(k)},
                                              weight(i));
                if (circle.square >= 0.0) continue;
                bool regular = true;
                for (int other = 0; other < n && regular; ++other)
                    regular = other == i || other == j || other == k ||
                              (circle.centre - x[at(other)]).squaredNorm() - weight(other) >= circle.square;
                if (regular) add({i, j, k});
            }
    for (int d = 0; d < n; ++d)
        result.discs_outside += radius[at(d)] * radius[at(d)] * (std::numbers::pi - 0.5 * turned[at(d)]);
    return result;
}

/// What the closing by rho adds to the complex: at each point where two grown circles meet outside all others
/// a hollow fillet between the two discs, with a waist where the fillets of both sides would overlap.
inline double fillets(std::span<const Vec2> x, std::span<const double> radius, double rho) {
    double area = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = i + 1; j < x.size(); ++j) {
            const Vec2 line = x[j] - x[i];
            const double distance = line.norm();
            const double a = radius[i] + rho, b = radius[j] + rho;
            if (distance >= a + b) continue;
            const double along = (distance * distance + a * a - b * b) / (2.0 * distance);
            const double height = std::sqrt(a * a - along * along);
            const double angle_i = std::acos(along / a), angle_j = std::acos((distance - along) / b);
            const double fillet =
                0.5 * (distance * height - radius[i] * radius[i] * angle_i - radius[j] * radius[j] * angle_j -
                       rho * rho * (std::numbers::pi - angle_i - angle_j));
            int exposed = 0;
            for (const double side : {-1.0, 1.0}) {
                const Vec2 corner = x[i] + (along * line + side * height * perpendicular(line)) / distance;
                bool outside = true;
                for (std::size_t k = 0; k < x.size() && outside; ++k)
                    outside = k == i || k == j || (corner - x[k]).norm() >= radius[k] + rho;
                exposed += outside ? 1 : 0;
            }
            area += exposed * fillet;
            if (exposed == 2 && height < rho)
                area += 2.0 * (rho * rho * std::acos(height / rho) -
                               height * std::sqrt(rho * rho - height * height));
        }
    return area;
}

}  // namespace softgrain::bpm
