#include "mpm/laws/saint_venant_kirchhoff.hpp"

namespace softgrain::mpm {

namespace {

Mat2 green_strain(const Mat2& F) {
    return 0.5 * (F.transpose() * F - Mat2::Identity());
}

double energy_of(const Mat2& strain, const ElasticConstants& c) {
    const double trace = strain.trace();
    return 0.5 * c.lambda * (trace * trace) + c.mu * strain.squaredNorm();
}

/// dP_iJ/dF_kL = delta_ik S_JL + lambda F_iJ F_kL + mu (F_iL F_kJ + (F F^T)_ik delta_JL)
Mat4 tangent_of(const Mat2& F, const Mat2& second_stress, const ElasticConstants& c) {
    const Mat2 b = F * F.transpose();
    Mat4 tangent;
    for (int a = 0; a < 4; ++a) {
        for (int d = 0; d < 4; ++d) {
            const int i = a / 2, J = a % 2, k = d / 2, L = d % 2;
            double sum = c.lambda * (F(i, J) * F(k, L)) + c.mu * (F(i, L) * F(k, J));
            if (i == k) sum += second_stress(J, L);
            if (J == L) sum += c.mu * b(i, k);
            tangent(a, d) = sum;
        }
    }
    return tangent;
}

}  // namespace

void SaintVenantKirchhoff::respond(std::span<const Mat2> F, std::span<const PlasticState> /*state*/,
                                   bool with_tangent, std::span<Response> out) const {
    for (std::size_t n = 0; n < F.size(); ++n) {
        const Mat2 strain = green_strain(F[n]);
        const Mat2 second_stress =
            constants_.lambda * strain.trace() * Mat2::Identity() + 2.0 * constants_.mu * strain;
        const Mat2 P = F[n] * second_stress;
        out[n].energy = energy_of(strain, constants_);
        out[n].stress << P(0, 0), P(0, 1), P(1, 0), P(1, 1);
        if (with_tangent) out[n].tangent = tangent_of(F[n], second_stress, constants_);
    }
}

double SaintVenantKirchhoff::stress_zz(const Mat2& F) const {
    return constants_.lambda * 0.5 * (F.squaredNorm() - 2.0);
}

double SaintVenantKirchhoff::stored(const Mat2& F, const PlasticState& /*after*/) const {
    return energy_of(green_strain(F), constants_);
}

}  // namespace softgrain::mpm
