#pragma once
// Consistent mass of the unit disc, factored once for all grains of a resolution.
#include <span>
#include <vector>

#include "mpm/disc/reference_disc.hpp"
#include "mpm/disc/stiffness_pattern.hpp"

namespace softgrain::mpm {

struct RigidMotion {
    Vec2 center, velocity;  ///< [m], [m/s]
    double spin;            ///< [1/s]

    Vec2 at(const Vec2& x) const { return velocity + spin * perpendicular(x - center); }
};

/// m_ij = integral of N_i N_j over the unit disc, by the weights of the material points; that of a grain is
/// density * area [kg] times it. Row sums would not do: those of extrapolated splines may be negative.
class Mass {
  public:
    Mass(const ReferenceDisc& disc, const StiffnessPattern& pattern);

    /// x = M^-1 x, both components. x [nodes].
    void solve(std::span<Vec2> x) const;
    /// y = M x.
    void apply(std::span<const Vec2> x, std::span<Vec2> y) const;
    /// x . M x
    double squared(std::span<const Vec2> x) const;
    /// Integral of the field v over the disc: momentum if v is a velocity.
    Vec2 momentum(std::span<const Vec2> v) const;
    /// Integral of x cross v, about the origin.
    double angular_momentum(std::span<const Vec2> q, std::span<const Vec2> v) const;
    /// With the momentum and the angular momentum of v. q, v [nodes].
    RigidMotion rigid_motion(std::span<const Vec2> q, std::span<const Vec2> v) const;
    /// m_ij in each place of the pattern.
    const std::vector<double>& in_pattern() const { return value_; }

  private:
    const ReferenceDisc& disc_;
    const StiffnessPattern& pattern_;
    std::vector<double> value_;

    // P M P^T = L L^T, L by columns without its diagonal.
    std::vector<int> place_;  ///< of each node in the order of L
    std::vector<int> start_, row_;
    std::vector<double> lower_, inverse_diagonal_;
};

}  // namespace softgrain::mpm
