#pragma once
// Compressible neo-Hookean solid in plane strain:
// W = mu/2 (J^(-2/3) I1 - 3) + kappa/2 (J-1)^2, I1 = tr(F^T F) + 1.
#include <Eigen/Core>
#include <cmath>

namespace softgrain::reference {

/// 2 x 2 tensors as (11, 12, 21, 22).
using Tensor = Eigen::Vector4d;
using Tangent = Eigen::Matrix4d;

struct Material {
    double mu, kappa;  ///< [Pa]

    Material(double young, double poisson)
        : mu(young / (2.0 * (1.0 + poisson))), kappa(young / (3.0 * (1.0 - 2.0 * poisson))) {}
};

inline double determinant(const Tensor& F) {
    return F[0] * F[3] - F[1] * F[2];
}

/// Energy density with its first and second derivative by F.
struct Response {
    double energy = 0.0;
    Tensor stress = Tensor::Zero();
    Tangent tangent = Tangent::Zero();
};

namespace detail {
/// Adds the parts that come from a function of J with first and second derivative d1, d2.
inline void add_determinant_part(Response& r, const Tensor& cofactor, double d1, double d2) {
    r.stress += d1 * cofactor;
    r.tangent += d2 * cofactor * cofactor.transpose();
    r.tangent(0, 3) += d1;
    r.tangent(3, 0) += d1;
    r.tangent(1, 2) -= d1;
    r.tangent(2, 1) -= d1;
}
}  // namespace detail

/// The first term of W; J > 0.
inline Response shape_response(const Material& m, const Tensor& F) {
    const double J = determinant(F), I1 = F.squaredNorm() + 1.0, scale = std::pow(J, -2.0 / 3.0);
    const Tensor cofactor{F[3], -F[2], -F[1], F[0]};
    Response r;
    r.energy = 0.5 * m.mu * (scale * I1 - 3.0);
    r.stress = m.mu * scale * F;
    r.tangent = m.mu * scale * Tangent::Identity();
    const double mixed = -2.0 / 3.0 * m.mu * scale / J;
    r.tangent += mixed * (F * cofactor.transpose() + cofactor * F.transpose());
    detail::add_determinant_part(r, cofactor, 0.5 * mixed * I1, -5.0 / 6.0 * mixed * I1 / J);
    return r;
}

/// The second term of W.
inline Response volume_response(const Material& m, const Tensor& F) {
    const double strain = determinant(F) - 1.0;
    Response r;
    r.energy = 0.5 * m.kappa * strain * strain;
    detail::add_determinant_part(r, Tensor{F[3], -F[2], -F[1], F[0]}, m.kappa * strain, m.kappa);
    return r;
}

}  // namespace softgrain::reference
