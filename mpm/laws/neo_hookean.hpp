#pragma once
// Rubber-like grains: W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J - 1)^2.
#include "mpm/laws/elastic_constants.hpp"
#include "mpm/laws/grain_law.hpp"

namespace softgrain::mpm {

/// I1 = tr(F^T F) + 1: the stretch out of the plane is 1. Splits into distortion and U(J) = kappa/2 (J -
/// 1)^2.
class NeoHookean : public GrainLaw {
  public:
    explicit NeoHookean(const ElasticConstants& constants) : constants_(constants) {}

    void respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                 std::span<Response> out) const override;
    bool splits() const override { return true; }
    Volumetric volumetric(double J) const override;
    double stored(const Mat2& F, const PlasticState& after) const override;

  protected:
    double mu() const { return constants_.mu; }

  private:
    ElasticConstants constants_;
};

}  // namespace softgrain::mpm
