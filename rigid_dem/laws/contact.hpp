#pragma once
// One contact over one step, put together from the parts that a scene has. Without branches, so that a loop
// over contacts becomes vectors.
#include <algorithm>
#include <cmath>

#include "common/simd.hpp"
#include "rigid_dem/laws/constants.hpp"
#include "rigid_dem/laws/normal.hpp"

namespace softgrain::rigid_dem {

/// n points from i to j, s = n turned by +90 degrees.
struct ContactInput {
    double overlap = 0.0;           ///< negative if apart [m]
    double closing = 0.0;           ///< speed of approach [m/s]
    double slip = 0.0;              ///< velocity of j's surface against i's along s [m/s]
    double spin_difference = 0.0;   ///< of i against j [1/s]
    double k = 0.0;                 ///< of the normal law
    double shear_ratio = 0.0;       ///< tangential / normal stiffness
    double shear_compliance = 0.0;  ///< 1 / tangential stiffness, if that is constant [m/N]
    double inverse_mass = 1.0;      ///< 1/m_i + 1/m_j [1/kg]
    double rolling_radius = 0.0;    ///< R_i R_j / (R_i + R_j) [m]
    double adhesive_length = 0.0;   ///< diameter of the smaller grain [m]
};

/// What a contact remembers from the last step.
struct ContactMemory {
    double shear = 0.0;    ///< tangential force on i along s [N]
    double dashpot = 0.0;  ///< damping part of the normal force [N]
    double grip = 0.0;     ///< tangential stiffness, if it changes with the overlap [N/m]
    double moment = 0.0;   ///< rolling moment on i [N m]
    double bond = 0.0;     ///< 1 while it holds tension
};

struct ContactForce {
    double normal;         ///< compression positive [N]
    double shear, moment;  ///< as in the memory
    // dissipated in this step [J]
    double friction_loss, damping_loss, adhesion_loss;
};

/// Forces after a step dt, and the memory with them.
/// Damping: c = 2 zeta sqrt(m_eff k), k the present stiffness, so that restitution does not depend on speed
/// (of Hertz contacts too: Antypov and Elliott 2011, EPL 94, 50004).
/// Friction: t += k_t slip dt, |t| <= mu N (DEM course, "Coulomb's friction"). Where k_t falls with the
/// overlap t falls with it, so that no energy is gained (Mindlin without micro-slip; Walton and Braun 1986).
/// Rolling: m -= k_r (w_i - w_j) dt, |m| <= mu_r R N (Iwashita and Oda 1998; type C of Ai et al. 2011).
/// Adhesion: a bond holds a pull up to `adhesion`, and adds to the Coulomb limit; beyond either it breaks.
/// Losses: work of the mean force over the step, less the change of the stored energy.
template <class Normal, unsigned features>
SOFTGRAIN_INLINE ContactForce contact_force(const ContactInput& in, ContactMemory& memory,
                                            const LawConstants& law, double dt) {
    static_assert(!(features & (has_rolling | has_adhesion)) || (features & has_friction));
    static_assert(Normal::constant_stiffness || !(features & has_adhesion));
    ContactForce out{};
    const bool pressed = in.overlap > 0.0;
    const double spring = Normal::force(in.k, in.overlap);
    const double stiffness = Normal::stiffness(in.k, in.overlap);
    double total = spring;
    if constexpr (features & has_damping)
        total += law.damping * std::sqrt(stiffness / in.inverse_mass) * in.closing;

    double bond = 0.0, bonded = 0.0, pull = 0.0;
    if constexpr (features & has_adhesion) {
        bonded = pressed ? std::max(memory.bond, law.sticks) : memory.bond;
        pull = bonded * law.adhesion * in.adhesive_length;
        bond = -spring > pull ? 0.0 : bonded;
        pull *= bond;
    }
    double normal = std::max(total, -pull);
    bool touching = pressed | (bond > 0.0);

    if constexpr (features & has_friction) {
        const double grip = in.shear_ratio * stiffness, increment = in.slip * dt;
        double before = memory.shear;
        if constexpr (!Normal::constant_stiffness) before *= memory.grip > grip ? grip / memory.grip : 1.0;
        const double trial = before + grip * increment;
        double limit = law.friction * std::max(normal, 0.0);
        if constexpr (features & has_adhesion) {
            const double strength = limit + law.shear_adhesion * pull;
            bond = std::abs(trial) > strength ? 0.0 : bond;
            limit = bond > 0.0 ? strength : limit;
            normal = bond > 0.0 ? normal : std::max(normal, 0.0);
            touching = pressed | (bond > 0.0);
            out.adhesion_loss = (bonded > 0.0) & !touching ? Normal::energy(in.k, in.overlap) : 0.0;
            memory.bond = bond;
        }
        const double shear = std::min(std::max(trial, -limit), limit);
        if constexpr (Normal::constant_stiffness) {
            const double slid = increment - (shear - before) * in.shear_compliance;
            const double lost = shear == trial ? 0.0 : 0.5 * (before + shear) * slid;
            out.friction_loss = touching ? lost : 0.5 * before * before * in.shear_compliance;
        } else {
            const double stored = memory.grip > 0.0 ? 0.5 * memory.shear * memory.shear / memory.grip : 0.0;
            const double change = 0.5 * (memory.shear + shear) * increment - 0.5 * shear * shear / grip;
            out.friction_loss = stored + (touching ? change : 0.0);
            memory.grip = touching ? grip : 0.0;
        }
        out.shear = memory.shear = touching ? shear : 0.0;

        if constexpr (features & has_rolling) {
            const double roller = law.rolling_stiffness * grip * in.rolling_radius * in.rolling_radius;
            const double most = law.rolling_friction * in.rolling_radius * std::max(normal, 0.0);
            const double turn = -in.spin_difference * dt, held = memory.moment;
            const double wanted = held + roller * turn;
            const double moment = std::min(std::max(wanted, -most), most);
            const double rolled = turn - (moment - held) / roller;
            const double lost = moment == wanted ? 0.0 : 0.5 * (held + moment) * rolled;
            out.friction_loss += touching ? lost : held == 0.0 ? 0.0 : 0.5 * held * held / roller;
            out.moment = memory.moment = touching ? moment : 0.0;
        }
    }
    out.normal = touching ? normal : 0.0;
    if constexpr (features & has_damping) {
        const double dashpot = touching ? normal - spring : 0.0;
        out.damping_loss = touching ? 0.5 * (memory.dashpot + dashpot) * in.closing * dt : 0.0;
        memory.dashpot = dashpot;
    }
    return out;
}

}  // namespace softgrain::rigid_dem
