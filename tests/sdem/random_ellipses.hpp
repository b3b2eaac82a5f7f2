#pragma once
// Random pairs of ellipses at a given depth of overlap.
#include <cmath>
#include <random>

#include "long_double_chord.hpp"

namespace softgrain::sdem::test {

inline Mat2 rotation(double angle) {
    Mat2 R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    return R;
}

/// F with principal stretches 1 +- strain, turned at random.
inline Mat2 random_F(std::mt19937_64& random, double strain) {
    std::uniform_real_distribution<double> stretch(1.0 - strain, 1.0 + strain), angle(0.0, 6.28);
    const Mat2 U = Vec2{stretch(random), stretch(random)}.asDiagonal();
    return rotation(angle(random)) * U * rotation(angle(random));
}

/// A pair that touches where the outward normal of i is `normal`, brought to any overlap along it.
struct RandomPair {
    Ellipse i;
    Mat2 F_j;
    double R_j;
    Vec2 normal, touch;  ///< centre of j at first touch

    RandomPair(std::mt19937_64& random, double strain, double smallest_radius) {
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        i = make_ellipse(Vec2{unit(random), unit(random)}, random_F(random, strain), 1.0);
        R_j = smallest_radius + (1.0 - smallest_radius) * unit(random);
        F_j = random_F(random, strain);
        const double angle = 6.28 * unit(random);
        normal = Vec2{std::cos(angle), std::sin(angle)};
        const auto extreme = [&](const Mat2& axes) {
            return Vec2{axes * (axes.transpose() * normal).normalized()};
        };
        touch = i.center + extreme(i.axes) + extreme(R_j * F_j);
    }
    Ellipse j(double overlap) const { return make_ellipse(touch - overlap * normal, F_j, R_j); }
};

}  // namespace softgrain::sdem::test
