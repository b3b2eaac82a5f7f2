#pragma once
// Hooke's law of small strains, for comparison with linear solutions.
#include "mpm/laws/elastic_constants.hpp"
#include "mpm/laws/grain_law.hpp"

namespace softgrain::mpm {

/// W = lambda/2 tr(e)^2 + mu e:e with e = (F + F^T)/2 - 1. Not objective: a rotation by a has the stress of
/// the strain cos a - 1.
class Linear final : public GrainLaw {
  public:
    explicit Linear(const ElasticConstants& constants);

    void respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                 std::span<Response> out) const override;
    double stress_zz(const Mat2& F) const override;
    double stored(const Mat2& F, const PlasticState& after) const override;

  private:
    double lambda_;
    Mat4 tangent_;
};

}  // namespace softgrain::mpm
