#pragma once
// Moduli of an isotropic grain in plane strain.
#include "common/scenario.hpp"

namespace softgrain::mpm {

/// Of a solid whose section is the plane: strains out of the plane are zero, stresses are not [N/m].
struct ElasticConstants {
    double mu, kappa, lambda;

    /// Poisson's ratio below 0.5.
    explicit ElasticConstants(const Material& material)
        : mu(material.youngs_modulus / (2.0 * (1.0 + material.poisson_ratio))),
          kappa(material.youngs_modulus / (3.0 * (1.0 - 2.0 * material.poisson_ratio))),
          lambda(kappa - 2.0 / 3.0 * mu) {}
};

}  // namespace softgrain::mpm
