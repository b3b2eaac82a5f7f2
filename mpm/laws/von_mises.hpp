#pragma once
// Rubber-like grains that flow: perfect J2 plasticity of finite strain.
#include "mpm/laws/neo_hookean.hpp"

namespace softgrain::mpm {

/// Neo-Hookean in the elastic part of F = Fe Fp, det Fp = 1; flow keeps sqrt(3/2) |dev tau| <= yield stress
/// of the Kirchhoff stress tau (Simo and Hughes, Computational Inelasticity, section 9.2). A step minimises
///     w(elastic distortion at its end) + yield stress x increment of the equivalent plastic strain
/// over the flow (Ortiz and Stainier 1999), along the exponential map: the minimum is Response::energy, P and
/// the symmetric tangent are its derivatives. Pressure does not flow: U(J) is the neo-Hookean one.
class VonMises final : public NeoHookean {
  public:
    /// yield_stress > 0 [N/m]
    VonMises(const ElasticConstants& constants, double yield_stress)
        : NeoHookean(constants), yield_stress_(yield_stress) {}

    void respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                 std::span<Response> out) const override;
    bool remembers() const override { return true; }
    void flow(std::span<const Mat2> F, std::span<PlasticState> state) const override;

  private:
    double radius() const;  ///< |dev tau| / mu at yield

    double yield_stress_;
};

}  // namespace softgrain::mpm
