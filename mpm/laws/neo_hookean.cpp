#include "mpm/laws/neo_hookean.hpp"

#include "mpm/laws/isochoric.hpp"

namespace softgrain::mpm {

void NeoHookean::respond(std::span<const Mat2> F, std::span<const PlasticState> /*state*/, bool with_tangent,
                         std::span<Response> out) const {
    const PlasticState none;
    for (std::size_t i = 0; i < F.size(); ++i)
        respond_isochoric(F[i], none, ElasticStrain(F[i], none), constants_.mu, with_tangent, out[i]);
}

Volumetric NeoHookean::volumetric(double J) const {
    const double slope = constants_.kappa * (J - 1.0);
    return {0.5 * slope * (J - 1.0), slope, constants_.kappa};
}

double NeoHookean::stored(const Mat2& F, const PlasticState& after) const {
    return ElasticStrain(F, after).energy(constants_.mu);
}

}  // namespace softgrain::mpm
