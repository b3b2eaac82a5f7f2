#include "mpm/laws/return_to_yield.hpp"

#include <array>
#include <cmath>
#include <numbers>

namespace softgrain::mpm {

namespace {

constexpr double sqrt2 = std::numbers::sqrt2;
const double sqrt6 = std::sqrt(6.0);

/// The strain of determinant 1 with the given deviator t: a third of its trace is the largest root m of
/// prod (m + t_k) = 1. The product is convex beyond it, so that Newton falls to the root from above.
IsochoricStrain strain_of(const Deviator& deviator) {
    const auto t = deviator.values();
    double m = 1.0 + deviator.norm();
    for (;;) {
        const double a = m + t[0], b = m + t[1], c = m + t[2];
        const double next = m - (a * b * c - 1.0) / (a * b + (a + b) * c);
        if (!(next < m)) break;
        m = next;
    }
    return {deviator.u / sqrt2, m + t[2]};
}

/// A point of the yield surface.
struct SurfacePoint {
    Deviator normal, across;  ///< unit vectors
    IsochoricStrain strain;
    double compliance;  ///< across . d(logarithmic strain)/d(angle) > 0

    SurfacePoint(double angle, double radius)
        : normal{std::cos(angle), std::sin(angle)},
          across{-normal.v, normal.u},
          strain(strain_of({radius * normal.u, radius * normal.v})) {
        // The mean of the values changes such that their product stays 1.
        const auto p = across.values();
        const std::array<double, 3> weight{1.0 / strain.first(), 1.0 / strain.second(), 1.0 / strain.zz()};
        double sum = 0.0, mean = 0.0, spread = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            sum += weight[k];
            mean += weight[k] * p[k];
        }
        mean /= sum;
        for (std::size_t k = 0; k < 3; ++k) spread += weight[k] * (p[k] - mean) * (p[k] - mean);
        compliance = 0.5 * radius * spread;
    }
};

double sinh_ratio(double x) {
    const double square = x * x;
    return square < 1e-6 ? 1.0 + square / 6.0 * (1.0 + square / 20.0) : std::sinh(x) / x;
}

}  // namespace

double Deviator::norm() const {
    return std::hypot(u, v);
}

std::array<double, 3> Deviator::values() const {
    return {u / sqrt2 + v / sqrt6, -u / sqrt2 + v / sqrt6, -2.0 * v / sqrt6};
}

IsochoricStrain::IsochoricStrain(double half_difference, double zz)
    : half_difference_(half_difference),
      zz_(zz),
      mean_(std::sqrt(half_difference * half_difference + 1.0 / zz)) {}

Deviator IsochoricStrain::deviator() const {
    return {sqrt2 * half_difference_, (2.0 / sqrt6) * (mean_ - zz_)};
}

Deviator IsochoricStrain::logarithmic() const {
    return {std::asinh(half_difference_ * std::sqrt(zz_)) / sqrt2, -0.25 * sqrt6 * std::log(zz_)};
}

YieldReturn return_to_yield(const IsochoricStrain& trial, double radius) {
    // Newton in the angle of n, from that of the trial stress, which is the limit for small flow. In 2e6
    // random returns (radii from 1e-6 to 30, logarithmic strains up to 30) it never took more than 7 steps.
    constexpr int most = 20;
    const Deviator strain = trial.logarithmic(), stress = trial.deviator();
    double angle = std::atan2(stress.v, stress.u);
    bool found = false;
    for (int k = 0;; ++k) {
        const SurfacePoint point(angle, radius);
        const Deviator end = point.strain.logarithmic();
        const Deviator flow{strain.u - end.u, strain.v - end.v};
        const double astray = point.across.u * flow.u + point.across.v * flow.v;
        const double along = point.normal.u * flow.u + point.normal.v * flow.v;
        const double slope = along + point.compliance;
        if (found || k == most) return {point.strain, point.normal, along, radius / slope};
        const double step = astray / slope;
        found = std::abs(step) < 1e-9;  // the error left is of the order of its square
        angle += step;
    }
}

double stress_over_strain(const IsochoricStrain& trial, const YieldReturn& step, double radius) {
    // With D = log(b1/b2)/2 the difference of the values is 2 sinh(D)/sqrt(zz), and D = D' + flow (n1 - n2),
    // where the prime is the end of the step and radius (n1 - n2) = 2 sinh(D')/sqrt(zz').
    const double before = sqrt2 * trial.logarithmic().u, after = sqrt2 * step.end.logarithmic().u;
    const double end_ratio = sinh_ratio(after), scale = 1.0 / std::sqrt(step.end.zz());
    return scale * std::sqrt(trial.zz()) * end_ratio / sinh_ratio(before) /
           (1.0 + 2.0 * step.flow / radius * scale * end_ratio);
}

}  // namespace softgrain::mpm
