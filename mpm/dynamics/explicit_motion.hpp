#pragma once
// Motion of the grains in time by explicit steps.
#include <optional>
#include <span>
#include <vector>

#include "common/checkpoint.hpp"
#include "common/grain_view.hpp"
#include "common/thread_choice.hpp"
#include "mpm/contact/contacts.hpp"
#include "mpm/contact/friction.hpp"
#include "mpm/dynamics/common_grid.hpp"
#include "mpm/dynamics/fastest_mode.hpp"
#include "mpm/dynamics/mass.hpp"
#include "mpm/grain_forces.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

/// Points that touch and part in steps near the limit give grains energy, more or less by chance: of the work
/// of walls in ten bounces without damping 1 to 6 % with penalty 200 at safety 0.8 and up to 0.4 % at 0.4 or
/// 0.5; up to 0.5 % with penalty 20 at 0.8 and 0.04 % at 0.4.
struct ExplicitSettings {
    double penalty = 200.0;                      ///< contact stiffness [modulus / grid spacing]
    double friction = 0.0, wall_friction = 0.0;  ///< Coulomb coefficients, of surfaces
    double damping = 0.0;         ///< of deformation: force / momentum against the rigid motion [1/s]
    Vec2 gravity = Vec2::Zero();  ///< [m/s^2]
    bool mean_dilatation = false;
    double safety = 0.8;                                 ///< time step / largest stable one
    std::optional<CommonGridSettings> common_grid = {};  ///< contact there instead of at the surfaces
};

/// Leap-frog: M dv/dt = -dU/dq. Velocities are kept at whole steps, as means of those half a step before and
/// after, so that the time step may change. After each step damping takes its share of what a grain's
/// velocities differ by from their rigid motion: momentum and angular momentum stay. On the common grid
/// velocities are those of half a step before: contacts make them jump.
class ExplicitMotion {
  public:
    ExplicitMotion(Grains& grains, const ExplicitSettings& settings);
    ExplicitMotion(const ExplicitMotion&) = delete;
    ExplicitMotion& operator=(const ExplicitMotion&) = delete;

    /// Starts at a state: forces, contacts and the stable time step become those of q, plastic and the box.
    /// Energies go on from `so_far`; only what is counted up is taken. q [all nodes].
    void begin(std::span<const Vec2> q, const Box& box, const EnergyLedger& so_far = {});

    /// All but q, v and plastic, which are to be as they were before load(). Throws InputError if there were
    /// other grains.
    void save(Checkpoint& to) const;
    void load(const Checkpoint& from, std::span<const Vec2> q);

    /// From the box as it is to `after`. q, v [all nodes]. Returns the first grain that was turned inside
    /// out, after which nothing is of use, or -1.
    [[nodiscard]] int step(std::span<Vec2> q, std::span<Vec2> v, const Box& after, double dt);

    /// Of the grains as they are deformed, known to some percent [s].
    double stable_time_step() const;
    /// By grains on walls; on the common grid the mean over the last step [N].
    std::array<Vec2, 4> wall_force() const;
    /// At the end of the last step.
    EnergyLedger energy(std::span<const Vec2> v) const;

    const Mass& mass() const { return mass_; }
    const Contacts& contacts() const { return contacts_; }
    const Surfaces& surfaces() const { return surfaces_; }
    const Friction& friction() const { return friction_; }
    const FastestMode& fastest_mode() const { return fastest_; }
    /// If contact is there.
    const CommonGrid* common_grid() const { return grid_ ? &*grid_ : nullptr; }

    /// Plastic states [grains * points], or empty.
    std::vector<PlasticState> plastic;

  private:
    /// Forces and accelerations at q. After a move plastic states follow. Returns as step().
    int evaluate(std::span<const Vec2> q, bool moved);
    /// Forces of its own deformation; looks whether its fastest mode is out of date if `looks`.
    void evaluate_grain(std::size_t g, std::span<const Vec2> q, bool flows, bool looks);
    /// Contact on the common grid. last: velocities of the last step.
    void collide(std::span<const Vec2> q, std::span<const Vec2> last, std::span<Vec2> v, const Box& after,
                 double dt);
    void kick(std::span<Vec2> v, double dt);
    void damp(std::span<const Vec2> q, std::span<Vec2> v, double dt);
    double kinetic_energy(std::span<const Vec2> v) const;
    double dissipated_by_flow(std::size_t g) const;

    Grains& grains_;
    ThreadChoice threads_;
    ExplicitSettings settings_;
    Mass mass_;
    std::vector<GrainForces> work_;  ///< one a thread
    Contacts contacts_;
    Surfaces surfaces_;
    Friction friction_;
    std::optional<CommonGrid> grid_;
    FastestMode fastest_;

    Box box_;
    std::vector<Vec2> force_;         ///< [all nodes] derivative of the energy [N]
    std::vector<Vec2> acceleration_;  ///< [all nodes] without damping [m/s^2]
    std::vector<double> elastic_;     ///< [grains] [J]
    long long steps_ = 0;             ///< since begin()
    EnergyLedger counted_;            ///< all but kinetic, elastic and plastic
};

}  // namespace softgrain::mpm
