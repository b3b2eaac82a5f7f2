#include "mpm/laws/von_mises.hpp"

#include <cmath>

#include "mpm/laws/isochoric.hpp"
#include "mpm/laws/return_to_yield.hpp"

namespace softgrain::mpm {

namespace {

/// What rounding leaves beyond the yield surface is elastic, relative to mu: a step without motion does not
/// flow.
constexpr double slack = 1e-13;
const double equivalent_per_flow = std::sqrt(2.0 / 3.0);

/// Elastic strain b = J^(-2/3) F G F^T before flow.
struct Trial {
    ElasticStrain elastic;
    double half_difference, shear;  ///< (b_xx - b_yy)/2 and b_xy, times J^(2/3)
    IsochoricStrain strain;

    Trial(const Mat2& F, const PlasticState& G)
        : elastic(F, G),
          half_difference(0.5 * ((elastic.FG[0] * F(0, 0) + elastic.FG[1] * F(0, 1)) -
                                 (elastic.FG[2] * F(1, 0) + elastic.FG[3] * F(1, 1)))),
          shear(elastic.FG[0] * F(1, 0) + elastic.FG[1] * F(1, 1)),
          strain(elastic.shrink * std::hypot(half_difference, shear), elastic.shrink * G.inverse_zz) {}

    bool flows(double radius) const { return strain.deviator().norm() > radius + slack; }
};

/// Principal axes of the trial strain in the plane, and F^-1 times them. Flow keeps the axes.
struct Axes {
    Vec2 axis[2], pulled[2];

    Axes(const Mat2& F, const Trial& trial) {
        const double angle = 0.5 * std::atan2(trial.shear, trial.half_difference);
        axis[0] = {std::cos(angle), std::sin(angle)};
        axis[1] = perpendicular(axis[0]);
        Mat2 inverse;
        inverse << F(1, 1), -F(0, 1), -F(1, 0), F(0, 0);
        for (int k = 0; k < 2; ++k) pulled[k] = inverse * axis[k] / trial.elastic.J;
    }
    /// By a change of F the velocity gradient dF F^-1 has the component (i, k) of this tensor : dF.
    Vec4 gradient(int i, int k) const {
        return {axis[i].x() * pulled[k].x(), axis[i].x() * pulled[k].y(), axis[i].y() * pulled[k].x(),
                axis[i].y() * pulled[k].y()};
    }
};

/// With tau_k the principal values of dev tau, b_k those of the trial strain, L_ik = Axes::gradient(i, k):
///     P = sum tau_k L_kk
///     dP/dF = sum (dtau_i/de_k - tau_i delta_ik) L_ii x L_kk + q b_2 L_12 x L_12 + q b_1 L_21 x L_21
///             + (q b_1 - tau_1) (L_12 x L_21 + L_21 x L_12),   q = (tau_1 - tau_2)/(b_1 - b_2)
void respond_flowing(const Mat2& F, const Trial& trial, double radius, double mu, bool with_tangent,
                     Response& out) {
    const YieldReturn step = return_to_yield(trial.strain, radius);
    const Axes axes(F, trial);
    const auto normal = step.normal.values();
    const double tau1 = mu * radius * normal[0], tau2 = mu * radius * normal[1];
    const Vec4 L11 = axes.gradient(0, 0), L22 = axes.gradient(1, 1);
    out.energy = mu * (0.5 * (step.end.trace() - 3.0) + radius * step.flow);
    out.stress = tau1 * L11 + tau2 * L22;
    if (!with_tangent) return;
    const auto across = Deviator{-step.normal.v, step.normal.u}.values();
    const Vec4 stiff = across[0] * L11 + across[1] * L22;
    const Vec4 L12 = axes.gradient(0, 1), L21 = axes.gradient(1, 0);
    const double q = mu * stress_over_strain(trial.strain, step, radius);
    const double mixed = q * trial.strain.mean() - 0.5 * (tau1 + tau2);  // q b_1 - tau_1 = q b_2 - tau_2
    const Vec4 shear12 = 0.5 * q * trial.strain.second() * L12 + mixed * L21;
    const Vec4 shear21 = 0.5 * q * trial.strain.first() * L21;
    out.tangent = (mu * step.stiffness) * (stiff * stiff.transpose()) - tau1 * (L11 * L11.transpose()) -
                  tau2 * (L22 * L22.transpose()) + shear12 * L12.transpose() + L12 * shear12.transpose() +
                  shear21 * L21.transpose() + L21 * shear21.transpose();
}

/// F^-1 b F^-T of the elastic strain b at the end of the step, brought to determinant 1.
void flow_to_yield(const Mat2& F, const Trial& trial, double radius, double yield_stress,
                   PlasticState& state) {
    const YieldReturn step = return_to_yield(trial.strain, radius);
    const Axes axes(F, trial);
    const Vec2 &a = axes.pulled[0], &b = axes.pulled[1];
    const double first = step.end.first(), second = step.end.second();
    const double xx = first * a.x() * a.x() + second * b.x() * b.x(),
                 xy = first * a.x() * a.y() + second * b.x() * b.y(),
                 yy = first * a.y() * a.y() + second * b.y() * b.y(), zz = step.end.zz();
    const double scale = 1.0 / std::cbrt((xx * yy - xy * xy) * zz);
    state.inverse_xx = scale * xx;
    state.inverse_xy = scale * xy;
    state.inverse_yy = scale * yy;
    state.inverse_zz = scale * zz;
    const double increment = equivalent_per_flow * step.flow;
    state.equivalent += increment;
    state.dissipated += yield_stress * increment;
}

}  // namespace

double VonMises::radius() const {
    return equivalent_per_flow * yield_stress_ / mu();
}

void VonMises::respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                       std::span<Response> out) const {
    for (std::size_t i = 0; i < F.size(); ++i) {
        const Trial trial(F[i], state[i]);
        if (trial.flows(radius()))
            respond_flowing(F[i], trial, radius(), mu(), with_tangent, out[i]);
        else
            respond_isochoric(F[i], state[i], trial.elastic, mu(), with_tangent, out[i]);
    }
}

void VonMises::flow(std::span<const Mat2> F, std::span<PlasticState> state) const {
    for (std::size_t i = 0; i < F.size(); ++i) {
        const Trial trial(F[i], state[i]);
        if (trial.flows(radius())) flow_to_yield(F[i], trial, radius(), yield_stress_, state[i]);
    }
}

}  // namespace softgrain::mpm
