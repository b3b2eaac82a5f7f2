#pragma once
// Small sets of grains, and how to deform them.
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "common/box.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm::test {

inline Mat2 rotation(double angle) {
    return (Mat2() << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle)).finished();
}
inline Vec2 random_vector(std::mt19937_64& random, double size) {
    std::uniform_real_distribution<double> part(-size, size);
    const double x = part(random);
    return {x, part(random)};
}

/// Grains of one material. frame [grains]: from the unit disc to each undeformed grain.
inline Grains grains_of(int cells, const std::vector<Mat2>& frame, const Material& material = {},
                        LawKind law = LawKind::neo_hookean) {
    Grains grains;
    grains.disc = reference_disc(cells);
    grains.pattern = std::make_shared<const StiffnessPattern>(*grains.disc);
    grains.dissection = std::make_shared<const Dissection>(*grains.disc, *grains.pattern);
    grains.law.push_back(make_law(law, material));
    const double nu = material.poisson_ratio;
    for (const Mat2& M : frame) {
        const double area = std::abs(M.determinant());
        grains.grain.push_back({grains.law.back().get(), M, M.inverse(), area, std::sqrt(area),
                                material.density, material.youngs_modulus / (1.0 - nu * nu)});
    }
    return grains;
}

/// Nodes of undeformed grains at these places.
inline std::vector<Vec2> nodes_at(const Grains& grains, const std::vector<Vec2>& center) {
    std::vector<Vec2> q;
    for (std::size_t g = 0; g < grains.size(); ++g)
        for (const Vec2& X : grains.disc->coordinate) q.push_back(center[g] + grains.grain[g].frame * X);
    return q;
}

/// Bends every grain by a random quadratic field; strains are up to about four times the size.
inline void bend(const Grains& grains, double size, std::mt19937_64& random, std::vector<Vec2>& q) {
    for (std::size_t g = 0; g < grains.size(); ++g) {
        Vec2 by[5];
        for (Vec2& b : by) b = random_vector(random, size * grains.grain[g].radius);
        for (std::size_t m = 0; m < grains.nodes(); ++m) {
            const Vec2& X = grains.disc->coordinate[m];
            q[g * grains.nodes() + m] += X.x() * by[0] + X.y() * by[1] + X.x() * X.x() * by[2] +
                                         X.x() * X.y() * by[3] + X.y() * X.y() * by[4];
        }
    }
}

/// A random vector for every node.
inline std::vector<Vec2> random_nodes(std::size_t count, double size, std::mt19937_64& random) {
    std::vector<Vec2> d;
    for (std::size_t m = 0; m < count; ++m) d.push_back(random_vector(random, size));
    return d;
}
inline std::vector<Vec2> sum(std::span<const Vec2> q, double factor, std::span<const Vec2> d) {
    std::vector<Vec2> moved(q.begin(), q.end());
    for (std::size_t m = 0; m < q.size(); ++m) moved[m] += factor * d[m];
    return moved;
}
inline double dot(std::span<const Vec2> a, std::span<const Vec2> b) {
    double s = 0.0;
    for (std::size_t m = 0; m < a.size(); ++m) s += a[m].dot(b[m]);
    return s;
}
inline double norm(std::span<const Vec2> a) {
    return std::sqrt(dot(a, a));
}

/// Bent discs of unequal size in rows between walls. depth: of overlaps, from nothing to twice as much [m];
/// radii are about 0.5.
struct Packing {
    Grains grains;
    std::vector<Vec2> q;
    Box box;

    Packing(int cells, int rows, int columns, double depth, unsigned seed, const Material& material = {}) {
        std::mt19937_64 random(seed);
        std::uniform_real_distribution<double> radius(0.5 - 0.5 * depth, 0.5 + 0.5 * depth);
        std::vector<Vec2> center;
        std::vector<Mat2> frame;
        const double apart = 1.0 - depth, rise = apart * std::sqrt(0.75);
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column) {
                center.emplace_back(apart * (column + 0.5 * (row % 2)), rise * row);
                center.back() += random_vector(random, 0.125 * depth);
                frame.emplace_back(radius(random) * Mat2::Identity());
            }
        grains = grains_of(cells, frame, material);
        q = nodes_at(grains, center);
        bend(grains, 0.25 * depth, random, q);
        const double wall = 0.5 * apart;
        box.position = {-wall, apart * (columns - 1 + (rows > 1 ? 0.5 : 0.0)) + wall, -wall,
                        rise * (rows - 1) + wall};
    }
};

}  // namespace softgrain::mpm::test
