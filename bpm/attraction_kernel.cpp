#include "bpm/attraction_kernel.hpp"

#include <cmath>

#include "bpm/power.hpp"
#include "common/simd.hpp"

namespace softgrain::bpm {
namespace {

// Closer to 1 than this, the difference of two powers would lose more digits than a logarithm is off.
constexpr double nearly_one = 1.0 + 1e-8;

/// With q = (a0/r)^2: force(q) = q^((gamma + 1)/2), and potential(q) whose difference to its value at the
/// cut-off is the integral of u^-gamma.
struct GammaSeven {
    SOFTGRAIN_INLINE double force(double q) const { return (q * q) * (q * q); }
    SOFTGRAIN_INLINE double potential(double q) const { return q * q * q * (1.0 / 6.0); }
};
struct GammaTwo {
    SOFTGRAIN_INLINE double force(double q) const { return q * std::sqrt(q); }
    SOFTGRAIN_INLINE double potential(double q) const { return std::sqrt(q); }
};
struct GammaOne {
    SOFTGRAIN_INLINE double force(double q) const { return q; }
    SOFTGRAIN_INLINE double potential(double q) const { return 0.34657359027997264 * binary_logarithm(q); }
};
struct AnyGamma {
    double gamma;
    SOFTGRAIN_INLINE double force(double q) const { return power_of(q, 0.5 * (gamma + 1.0)); }
    SOFTGRAIN_INLINE double potential(double q) const {
        return power_of(q, 0.5 * (gamma - 1.0)) / (gamma - 1.0);
    }
};

/// Always in this order.
SOFTGRAIN_INLINE double sum_of(const double* part) {
    return ((part[0] + part[4]) + (part[2] + part[6])) + ((part[1] + part[5]) + (part[3] + part[7]));
}

template <class Gamma>
SOFTGRAIN_INLINE void attract_all(Gamma gamma, const AttractionLaw& law, const StripedDiscs& g,
                                  double* force) {
    const double least_q = 1.0 / (law.cut_off() * law.cut_off());
    for (int n = 0; n < g.discs; ++n) {
        const double x = g.x[g.slot[n]], y = g.y[g.slot[n]], radius = g.radius[g.slot[n]];
        alignas(64) double fx[run_length] = {}, fy[run_length] = {};
        for (int k = g.start[n]; k < g.start[n + 1]; ++k) {
            const double* const other_x = g.x + g.run[k];
            const double* const other_y = g.y + g.run[k];
            const double* const other_radius = g.radius + g.run[k];
#pragma omp simd
            for (int l = 0; l < run_length; ++l) {
                const double dx = other_x[l] - x, dy = other_y[l] - y, a0 = radius + other_radius[l];
                const double touch = a0 * a0, apart = dx * dx + dy * dy;
                const double square = apart > touch ? apart : touch;
                const double share = 1.0 / (a0 * square);
                const double q = a0 * touch * share;
                const double f = q > least_q ? gamma.force(q) * (square * share) : 0.0;
                fx[l] += f * dx;
                fy[l] += f * dy;
            }
        }
        force[2 * g.disc[n]] = law.maximum_force * sum_of(fx);
        force[2 * g.disc[n] + 1] = law.maximum_force * sum_of(fy);
    }
}

template <class Gamma>
SOFTGRAIN_INLINE void add_potentials(Gamma gamma, const AttractionLaw& law, const StripedDiscs& g,
                                     double* energy) {
    const double least_q = 1.0 / (law.cut_off() * law.cut_off());
    const double at_cut_off = gamma.potential(least_q);
    for (int n = 0; n < g.discs; ++n) {
        const int own = g.slot[n];
        const double x = g.x[own], y = g.y[own], radius = g.radius[own];
        alignas(64) double sum[run_length] = {};
        for (int k = g.start[n]; k < g.start[n + 1]; ++k) {
            const int first = g.run[k];
#pragma omp simd
            for (int l = 0; l < run_length; ++l) {
                const double dx = g.x[first + l] - x, dy = g.y[first + l] - y,
                             a0 = radius + g.radius[first + l];
                const double touch = a0 * a0, apart = dx * dx + dy * dy;
                const double square = apart > touch ? apart : touch;
                const double q = touch / square;
                const double overlap = 0.5 * (1.0 - apart / touch);
                const double inside = overlap > 0.0 ? overlap : 0.0;
                const double work = a0 * ((gamma.potential(q) - at_cut_off) + inside);
                sum[l] += (q > least_q && first + l != own) ? work : 0.0;
            }
        }
        energy[g.disc[n]] = -0.5 * law.maximum_force * sum_of(sum);
    }
}

SOFTGRAIN_CLONES void attract_seven(const AttractionLaw& law, const StripedDiscs& g, double* force) {
    attract_all(GammaSeven{}, law, g, force);
}
SOFTGRAIN_CLONES void attract_two(const AttractionLaw& law, const StripedDiscs& g, double* force) {
    attract_all(GammaTwo{}, law, g, force);
}
SOFTGRAIN_CLONES void attract_one(const AttractionLaw& law, const StripedDiscs& g, double* force) {
    attract_all(GammaOne{}, law, g, force);
}
SOFTGRAIN_CLONES void attract_any(const AttractionLaw& law, const StripedDiscs& g, double* force) {
    attract_all(AnyGamma{law.exponent}, law, g, force);
}
SOFTGRAIN_CLONES void potentials_seven(const AttractionLaw& law, const StripedDiscs& g, double* energy) {
    add_potentials(GammaSeven{}, law, g, energy);
}
SOFTGRAIN_CLONES void potentials_two(const AttractionLaw& law, const StripedDiscs& g, double* energy) {
    add_potentials(GammaTwo{}, law, g, energy);
}
SOFTGRAIN_CLONES void potentials_one(const AttractionLaw& law, const StripedDiscs& g, double* energy) {
    add_potentials(GammaOne{}, law, g, energy);
}
SOFTGRAIN_CLONES void potentials_any(const AttractionLaw& law, const StripedDiscs& g, double* energy) {
    add_potentials(AnyGamma{law.exponent}, law, g, energy);
}

SOFTGRAIN_CLONES double move_of(const StripedDiscs& g, const double* x_before, const double* y_before) {
    alignas(64) double x_sum[run_length] = {}, y_sum[run_length] = {}, largest[run_length] = {};
    for (std::size_t first = 0; first < g.slots; first += run_length) {
#pragma omp simd
        for (int l = 0; l < run_length; ++l) {
            x_sum[l] += g.x[first + l] - x_before[first + l];
            y_sum[l] += g.y[first + l] - y_before[first + l];
        }
    }
    const double x_mean = sum_of(x_sum) / g.discs, y_mean = sum_of(y_sum) / g.discs;
    for (std::size_t first = 0; first < g.slots; first += run_length) {
#pragma omp simd
        for (int l = 0; l < run_length; ++l) {
            const double dx = g.x[first + l] - x_before[first + l] - x_mean;
            const double dy = g.y[first + l] - y_before[first + l] - y_mean;
            const double square = g.x[first + l] < far_away ? dx * dx + dy * dy : 0.0;
            largest[l] = square > largest[l] ? square : largest[l];
        }
    }
    double most = 0.0;
    for (const double square : largest) most = square > most ? square : most;
    return most;
}

}  // namespace

void attract(const AttractionLaw& law, const StripedDiscs& discs, double* force) {
    if (law.exponent == 7.0)
        attract_seven(law, discs, force);
    else if (law.exponent == 2.0)
        attract_two(law, discs, force);
    else if (law.exponent < nearly_one)
        attract_one(law, discs, force);
    else
        attract_any(law, discs, force);
}

void find_potentials(const AttractionLaw& law, const StripedDiscs& discs, double* energy) {
    if (law.exponent == 7.0)
        potentials_seven(law, discs, energy);
    else if (law.exponent == 2.0)
        potentials_two(law, discs, energy);
    else if (law.exponent < nearly_one)
        potentials_one(law, discs, energy);
    else
        potentials_any(law, discs, energy);
}

double largest_square_move(const StripedDiscs& discs, const double* x_before, const double* y_before) {
    return move_of(discs, x_before, y_before);
}

}  // namespace softgrain::bpm
