#include "bpm/attraction_law.hpp"

#include <cmath>

namespace softgrain::bpm {

double AttractionLaw::force(double distance, double a0) const {
    if (distance > cut_off() * a0) return 0.0;
    if (distance < a0) return maximum_force * distance / a0;
    return maximum_force * std::pow(1.0 + (distance - a0) / a0, -exponent);
}

double AttractionLaw::potential(double distance, double a0) const {
    const double at = distance / a0;
    if (at >= cut_off()) return 0.0;
    // Integral of u^-gamma from u = max(1, r/a0) to the cut-off.
    const double u = at > 1.0 ? at : 1.0;
    const double power = 1.0 - exponent, turns = std::log(cut_off() / u);
    const double outside = power == 0.0 ? turns : std::pow(u, power) * std::expm1(power * turns) / power;
    const double inside = at < 1.0 ? 0.5 * (1.0 - at * at) : 0.0;
    return -maximum_force * a0 * (outside + inside);
}

}  // namespace softgrain::bpm
