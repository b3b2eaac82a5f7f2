#pragma once
// The plainest objective law: stress linear in the Green strain.
#include "mpm/laws/elastic_constants.hpp"
#include "mpm/laws/grain_law.hpp"

namespace softgrain::mpm {

/// W = lambda/2 tr(E)^2 + mu E:E with E = (F^T F - 1)/2. Softens in compression, and is unstable in strong
/// compression: below a stretch of 1/sqrt(3) along one axis.
class SaintVenantKirchhoff final : public GrainLaw {
  public:
    explicit SaintVenantKirchhoff(const ElasticConstants& constants) : constants_(constants) {}

    void respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                 std::span<Response> out) const override;
    double stress_zz(const Mat2& F) const override;
    double stored(const Mat2& F, const PlasticState& after) const override;

  private:
    ElasticConstants constants_;
};

}  // namespace softgrain::mpm
