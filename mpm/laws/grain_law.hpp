#pragma once
// What a grain is made of: the energy of its deformation in plane strain, with stress and tangent.
#include <memory>
#include <span>

#include <Eigen/Core>

#include "common/scenario.hpp"
#include "common/vec.hpp"

namespace softgrain::mpm {

/// Components of a tensor in the plane as a vector: xx, xy, yx, yy.
using Vec4 = Eigen::Vector4d;
using Mat4 = Eigen::Matrix4d;

/// What plastic flow leaves behind at a material point.
struct PlasticState {
    double inverse_xx = 1.0, inverse_xy = 0.0, inverse_yy = 1.0,
           inverse_zz = 1.0;  ///< inverse plastic right Cauchy-Green tensor
    double equivalent = 0.0;  ///< accumulated equivalent plastic strain
    double dissipated = 0.0;  ///< by flow since the start, per undeformed area [J/m^2]
};

/// Answer of a law at one material point, per undeformed area. The energy of a law that splits is
/// `energy + U(J)`: this part, and Volumetric, which the solver may take at a mean J.
struct Response {
    double energy = 0.0;          ///< W [J/m^2]; of a plastic law with what the step has dissipated
    Vec4 stress = Vec4::Zero();   ///< first Piola-Kirchhoff P = dW/dF, tension positive [N/m]
    Mat4 tangent = Mat4::Zero();  ///< dP/dF, symmetric [N/m]
};

/// U(J) of a law that splits, and its derivatives.
struct Volumetric {
    double energy = 0.0;     ///< [J/m^2]
    double slope = 0.0;      ///< dU/dJ [N/m]
    double curvature = 0.0;  ///< d2U/dJ2 [N/m]
};

class GrainLaw {
  public:
    virtual ~GrainLaw() = default;

    /// F [n]; state [n], that of the last step, or empty if the law remembers nothing; out [n]. J = det F > 0
    /// is asked of laws that split. Without `with_tangent` the tangents are left as they are.
    virtual void respond(std::span<const Mat2> F, std::span<const PlasticState> state, bool with_tangent,
                         std::span<Response> out) const = 0;
    /// Whether the energy has a part U(J) of its own, to be added to that of respond().
    virtual bool splits() const { return false; }
    /// Only of a law that splits.
    virtual Volumetric volumetric(double J) const;
    /// Kirchhoff stress out of the plane, tension positive [N/m]; only of a law that does not split.
    virtual double stress_zz(const Mat2& F) const;
    /// Whether it has plastic states.
    virtual bool remembers() const { return false; }
    /// The states that the deformation F leaves behind: state [n], changed. Nothing if it does not remember.
    virtual void flow(std::span<const Mat2> F, std::span<PlasticState> state) const;
    /// Energy that would be given back on unloading, without U(J) [J/m^2].
    virtual double stored(const Mat2& F, const PlasticState& after) const = 0;
};

enum class LawKind { neo_hookean, saint_venant_kirchhoff, linear };

/// The law of a material; a yield stress makes a neo-Hookean grain elasto-plastic. Throws InputError if it is
/// given with another law.
std::unique_ptr<GrainLaw> make_law(LawKind kind, const Material& material);

}  // namespace softgrain::mpm
