#include "mpm/laws/grain_law.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "common/errors.hpp"
#include "mpm/laws/linear.hpp"
#include "mpm/laws/neo_hookean.hpp"
#include "mpm/laws/saint_venant_kirchhoff.hpp"
#include "mpm/laws/von_mises.hpp"

namespace softgrain::mpm {

Volumetric GrainLaw::volumetric(double /*J*/) const {
    throw std::logic_error("this law has no energy of volume of its own");
}

double GrainLaw::stress_zz(const Mat2& /*F*/) const {
    throw std::logic_error("this law's stress out of the plane follows from that in it");
}

void GrainLaw::flow(std::span<const Mat2> /*F*/, std::span<PlasticState> /*state*/) const {}

std::unique_ptr<GrainLaw> make_law(LawKind kind, const Material& material) {
    if (!(material.poisson_ratio < 0.5))
        throw InputError(
            fmt::format("poisson_ratio = {} of a grain's material: mpm needs grains that can be compressed; "
                        "use less than "
                        "0.5, for example 0.49",
                        material.poisson_ratio));
    if (material.yield_stress && kind != LawKind::neo_hookean)
        throw InputError(fmt::format(
            "yield_stress = {} of a grain's material: in mpm only neo-Hookean grains yield; leave it out or "
            "choose the neo-Hookean law",
            *material.yield_stress));
    const ElasticConstants constants(material);
    switch (kind) {
        case LawKind::neo_hookean:
            if (material.yield_stress) return std::make_unique<VonMises>(constants, *material.yield_stress);
            return std::make_unique<NeoHookean>(constants);
        case LawKind::saint_venant_kirchhoff:
            return std::make_unique<SaintVenantKirchhoff>(constants);
        case LawKind::linear:
            return std::make_unique<Linear>(constants);
    }
    throw std::logic_error("no such law of grains");
}

}  // namespace softgrain::mpm
