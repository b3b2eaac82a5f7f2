#pragma once
// Two undeformed unit discs of E = 1, their force from the law's energy and nothing of the solver.
#include <cmath>
#include <numbers>

#include "probe.hpp"
#include "sdem/laws/lens_potential.hpp"

namespace softgrain::sdem::test {

/// Half of the lens / pi: the overlap each of two unit discs gives way to, in its own area.
inline double unit_pair_share(double overlap) {
    const double sine = std::sqrt(overlap * (1.0 - 0.25 * overlap)), half = std::asin(sine), x = half * half;
    const double cap = half > 0.02 ? half - sine * std::sqrt(1.0 - sine * sine)
                                   : half * x * (2.0 / 3.0 - x * (2.0 / 15.0 - 4.0 / 315.0 * x));
    return cap / std::numbers::pi;
}

/// Normal force [N] at this overlap; G and the contacts' energy are differentiated numerically.
inline double unit_pair_force(double overlap, double nu) {
    const double mu = 1.0 / (2.0 + 2.0 * nu), kappa = 1.0 / (3.0 - 6.0 * nu), plane_E = 1.0 / (1.0 - nu * nu);
    const auto sums = [](double o) {
        LensPotential::Sums sum;
        sum.add(LensPotential::overlap(unit_pair_share(o)));
        return sum;
    };
    const auto G = [&](double o) { return LensPotential::inflation(sums(o), LensPotential::bulge(nu)).G; };
    const auto local = [&](double o) { return LensPotential::contact_energy(plane_E, 1.0, sums(o)); };
    const double step = 2e-3 * overlap;
    const double inflating = slope([&](double d) { return G(overlap + d); }, step);
    const double pressing = slope([&](double d) { return local(overlap + d); }, step);
    return 2.0 * std::numbers::pi *
           (LensPotential::pressure(1.0 - G(overlap), mu, kappa) * inflating + pressing);
}

}  // namespace softgrain::sdem::test
