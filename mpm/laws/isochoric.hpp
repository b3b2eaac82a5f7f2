#pragma once
// Energy of elastic distortion, the same for elastic and for elasto-plastic grains.
//
//     w = mu/2 (I J^(-2/3) - 3),   I = tr(F G F^T) + G_zz,   J = det F,   det G = 1
//
// G is the inverse plastic right Cauchy-Green tensor, the identity where nothing has flowed; the stretch out
// of the plane is 1 (Simo and Hughes, Computational Inelasticity, section 9.2).
#include <bit>
#include <cstdint>

#include "mpm/laws/grain_law.hpp"

namespace softgrain::mpm {

/// x^(-1/3) of a normal number x > 0 within 1.5e-16, measured, and faster than std::cbrt: the exponent over
/// -3 is within 4 %, then Newton's method.
inline double inverse_cube_root(double x) {
    double y = std::bit_cast<double>(std::uint64_t{0x553ef0ff289dd796} - std::bit_cast<std::uint64_t>(x) / 3);
    for (int step = 0; step < 4; ++step) y += y * (1.0 - x * y * y * y) * (1.0 / 3.0);
    return y;
}

/// The elastic strain that F makes of G.
struct ElasticStrain {
    double J;          ///< det F
    double shrink;     ///< J^(-2/3)
    Vec4 FG;           ///< F G
    double invariant;  ///< I

    ElasticStrain(const Mat2& F, const PlasticState& G)
        : J(F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0)),
          shrink(inverse_cube_root(J * J)),
          FG(F(0, 0) * G.inverse_xx + F(0, 1) * G.inverse_xy, F(0, 0) * G.inverse_xy + F(0, 1) * G.inverse_yy,
             F(1, 0) * G.inverse_xx + F(1, 1) * G.inverse_xy,
             F(1, 0) * G.inverse_xy + F(1, 1) * G.inverse_yy),
          invariant((FG[0] * F(0, 0) + FG[1] * F(0, 1)) + (FG[2] * F(1, 0) + FG[3] * F(1, 1)) +
                    G.inverse_zz) {}

    /// w [J/m^2]
    double energy(double mu) const { return 0.5 * mu * (shrink * invariant - 3.0); }
};

/// w and its derivatives; with C = dJ/dF
///     P = mu J^(-2/3) (F G - I/(3J) C)
///     dP/dF = mu J^(-2/3) (1 x G - 2/(3J) (FG x C + C x FG) + 5I/(9J^2) C x C - I/(3J) dC/dF)
inline void respond_isochoric(const Mat2& F, const PlasticState& G, const ElasticStrain& strain, double mu,
                              bool with_tangent, Response& out) {
    const double stiffness = mu * strain.shrink, per_J = 1.0 / strain.J;
    const double sphere = strain.invariant * per_J * (1.0 / 3.0);
    const Vec4 C(F(1, 1), -F(1, 0), -F(0, 1), F(0, 0));
    out.energy = strain.energy(mu);
    out.stress = stiffness * (strain.FG - sphere * C);
    if (!with_tangent) return;
    const Vec4 half = per_J * ((5.0 / 6.0) * sphere * C - (2.0 / 3.0) * strain.FG);
    const Vec4 scaled = stiffness * C;
    out.tangent.noalias() = scaled * half.transpose() + half * scaled.transpose();
    const double xx = stiffness * G.inverse_xx, xy = stiffness * G.inverse_xy, yy = stiffness * G.inverse_yy;
    const double turn = stiffness * sphere;
    out.tangent(0, 0) += xx;
    out.tangent(0, 1) += xy;
    out.tangent(1, 0) += xy;
    out.tangent(1, 1) += yy;
    out.tangent(2, 2) += xx;
    out.tangent(2, 3) += xy;
    out.tangent(3, 2) += xy;
    out.tangent(3, 3) += yy;
    out.tangent(0, 3) -= turn;
    out.tangent(3, 0) -= turn;
    out.tangent(1, 2) += turn;
    out.tangent(2, 1) += turn;
}

}  // namespace softgrain::mpm
