#pragma once
// From the coefficient of restitution to the dashpot.

namespace softgrain::rigid_dem {

/// Lowest restitution that a dashpot which never pulls can give, with some room.
inline constexpr double least_restitution = 0.15;

/// Share of critical damping for a linear contact: it ends when the force is zero (Schwager and Poeschel
/// 2007, Granular Matter 9, 465).
double linear_damping_ratio(double restitution);

/// The same for a Hertz contact, c = 2 zeta sqrt(m_eff dN/d(overlap)); its collision is integrated once.
double hertz_damping_ratio(double restitution);

}  // namespace softgrain::rigid_dem
