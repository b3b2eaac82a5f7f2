#pragma once
// One contact of rigid discs: linear spring and dashpot, incremental tangential spring with a Coulomb cap.
#include <algorithm>
#include <cmath>

namespace softgrain::rigid_dem {

/// What a contact remembers from the last step.
struct ContactMemory {
    double shear = 0.0;    ///< tangential force on i along perpendicular(n) [N]
    double dashpot = 0.0;  ///< damping part of the normal force [N]
};

struct NormalForce {
    double total;    ///< compression positive, never tensile [N]
    double dashpot;  ///< total - spring part [N]
};

/// N = max(0, k overlap + c closing_speed), c = 2 zeta sqrt(k m_eff) (DEM course, viscous damping).
inline NormalForce normal_force(double overlap, double closing_speed, double k, double zeta,
                                double effective_mass) {
    const double spring = k * overlap;
    const double total = std::max(0.0, spring + 2.0 * zeta * std::sqrt(k * effective_mass) * closing_speed);
    return {total, total - spring};
}

struct ShearForce {
    double force;       ///< [N]
    double dissipated;  ///< by sliding in this step [J]
};

/// t += k_t v_t dt, |t| <= mu N (DEM course, Coulomb). Work over the step is the mean force times the slip.
inline ShearForce shear_force(double before, double slip_increment, double k_t, double limit) {
    const double trial = before + k_t * slip_increment;
    const double force = std::clamp(trial, -limit, limit);
    const double slid = slip_increment - (force - before) / k_t;
    return {force, force == trial ? 0.0 : 0.5 * (before + force) * slid};
}

}  // namespace softgrain::rigid_dem
