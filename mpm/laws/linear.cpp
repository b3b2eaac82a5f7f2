#include "mpm/laws/linear.hpp"

namespace softgrain::mpm {

namespace {

Vec4 displacement_gradient(const Mat2& F) {
    return {F(0, 0) - 1.0, F(0, 1), F(1, 0), F(1, 1) - 1.0};
}

}  // namespace

Linear::Linear(const ElasticConstants& constants) : lambda_(constants.lambda) {
    const double mu = constants.mu, lambda = constants.lambda, uniaxial = lambda + 2.0 * mu;
    tangent_ << uniaxial, 0.0, 0.0, lambda,  //
        0.0, mu, mu, 0.0,                    //
        0.0, mu, mu, 0.0,                    //
        lambda, 0.0, 0.0, uniaxial;
}

void Linear::respond(std::span<const Mat2> F, std::span<const PlasticState> /*state*/, bool with_tangent,
                     std::span<Response> out) const {
    for (std::size_t i = 0; i < F.size(); ++i) {
        const Vec4 gradient = displacement_gradient(F[i]);
        out[i].stress = tangent_ * gradient;
        out[i].energy = 0.5 * gradient.dot(out[i].stress);
        if (with_tangent) out[i].tangent = tangent_;
    }
}

double Linear::stress_zz(const Mat2& F) const {
    return lambda_ * (F.trace() - 2.0);
}

double Linear::stored(const Mat2& F, const PlasticState& /*after*/) const {
    const Vec4 gradient = displacement_gradient(F);
    return 0.5 * gradient.dot(tangent_ * gradient);
}

}  // namespace softgrain::mpm
