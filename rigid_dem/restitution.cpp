#include "rigid_dem/restitution.hpp"

#include <cmath>
#include <numbers>

namespace softgrain::rigid_dem {
namespace {

double linear_restitution(double zeta) {
    const double damped = std::sqrt(1.0 - zeta * zeta);
    const double duration =
        (std::numbers::pi - std::atan2(2.0 * zeta * damped, 1.0 - 2.0 * zeta * zeta)) / damped;
    return std::exp(-zeta * duration);
}

/// Of q'' = -q^(3/2) - 2 zeta sqrt(3/2) q^(1/4) q', q(0) = 0, q'(0) = 1, until the force is zero; free of
/// units.
double hertz_restitution(double zeta) {
    constexpr double dt = 1e-3;
    const auto force = [&](double q, double rate) {
        return -q * std::sqrt(q) - 2.0 * zeta * std::sqrt(1.5 * std::sqrt(q)) * rate;
    };
    double q = 0.0, rate = 1.0;
    for (;;) {  // midpoint rule
        const double half_rate = rate + 0.5 * dt * force(q, rate), half_q = q + 0.5 * dt * rate;
        const double push = force(std::fmax(half_q, 0.0), half_rate);
        if (push >= 0.0 && rate < 0.0) return -rate;
        q += dt * half_rate;
        rate += dt * push;
        if (q <= 0.0) return -rate;
    }
}

template <class Restitution>
double damping_ratio(double wanted, const Restitution& restitution) {
    if (wanted >= 1.0) return 0.0;
    double low = 0.0, high = 1.0 - 1e-9;
    while (high - low > 1e-12) (restitution(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
    return low;
}

}  // namespace

double linear_damping_ratio(double restitution) {
    return damping_ratio(restitution, linear_restitution);
}

double hertz_damping_ratio(double restitution) {
    return damping_ratio(restitution, hertz_restitution);
}

}  // namespace softgrain::rigid_dem
