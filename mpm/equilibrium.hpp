#pragma once
// Equilibrium of all grains between walls: the minimum of the energy, by Newton's method.
#include <memory>
#include <string>
#include <vector>

#include "common/thread_choice.hpp"
#include "mpm/contact/contact_model.hpp"
#include "mpm/contact/contacts.hpp"
#include "mpm/contact/friction.hpp"
#include "mpm/dynamics/mass.hpp"
#include "mpm/grain_forces.hpp"
#include "mpm/grains.hpp"
#include "mpm/linear/linear_solver.hpp"

namespace softgrain::mpm {

struct EquilibriumSettings {
    double tolerance = 1e-5;  ///< largest unbalanced force of a node / largest force of a node
    int most_iterations = 200;
    double penalty = 200.0;  ///< contact stiffness [modulus / grid spacing]
    bool mean_dilatation = false;
    Vec2 gravity = Vec2::Zero();                 ///< [m/s^2]
    double friction = 0.0, wall_friction = 0.0;  ///< Coulomb coefficients
};

struct EquilibriumResult {
    bool converged = false;
    int iterations = 0;
    int factorizations = 0;  ///< of the contacts' part
    double residual = 0.0;   ///< as the tolerance
    int worst_node = 0;      ///< of all nodes
    std::string why;         ///< if it did not converge
};

/// Each step minimises a model of the energy: quadratic in the grains, with gaps that open and close linearly
/// (ContactModel), so that points which a step makes touch are foreseen. Where the energy is not convex the
/// nodes of contacts are held by springs to where they are (Levenberg 1944); none is left at the end. What
/// friction depends on, normal forces and places, is that of the last step until it no longer changes.
class Equilibrium {
  public:
    Equilibrium(Grains& grains, const EquilibriumSettings& settings, std::unique_ptr<LinearSolver> linear);

    /// Energy at q [J] and its derivative; infinite where a grain is inside out.
    double evaluate(std::span<const Vec2> q, const Box& box, std::span<Vec2> force);
    /// From now on nodes resist to come to other places than `to` [all nodes] with the mass of grains over
    /// dt^2: a step of the implicit Euler method. dt infinite: they do not, which is the state at first.
    void set_inertia(std::span<const Vec2> to, double dt);
    /// Friction starts from q as it is: springs keep their force, slip is none.
    void begin_slip(std::span<const Vec2> q, const Box& box, std::span<Vec2> force);
    /// Starts at q and leaves the solution in it, or the last try.
    EquilibriumResult find(std::vector<Vec2>& q, const Box& box);
    /// Of the last evaluate().
    const Contacts& contacts() const { return contacts_; }
    const Mass& mass() const { return mass_; }
    const Surfaces& surfaces() const { return surfaces_; }
    Friction& friction() { return friction_; }
    const Friction& friction() const { return friction_; }
    /// By grains on walls [N].
    std::array<Vec2, 4> wall_force() const;
    /// Stored in grains and contacts, without friction's springs [J].
    double elastic_energy() const { return elastic_; }

    /// Plastic states of the last step [grains * points], or empty.
    std::vector<PlasticState> plastic;

  private:
    /// A try of Newton's method.
    struct Trial {
        std::vector<Vec2> q, force;
        double energy;
    };

    double add_inertia(std::size_t g, std::span<const Vec2> q, std::span<Vec2> own) const;
    void find_grain_stiffness(std::span<const Vec2> q);
    /// Newton's step from q, where the force is known. False if there is none; raises the hold where it must.
    bool find_step(std::span<const Vec2> q, std::span<const Vec2> force, EquilibriumResult& result);
    void try_step(std::span<const Vec2> q, double share, const Box& box, Trial& trial);
    void hold_more() { hold_ = std::max(first_hold, hold_ * hold_up); }

    static constexpr double first_hold = 1e-7, hold_up = 5.0;  // [largest modulus]

    Grains& grains_;
    ThreadChoice threads_;
    EquilibriumSettings settings_;
    std::unique_ptr<LinearSolver> linear_;
    std::vector<GrainForces> work_;  ///< one a thread
    Mass mass_;
    Contacts contacts_;
    Friction friction_;
    ContactModel model_;
    Surfaces surfaces_;
    std::vector<Vec2> drift_;  ///< where inertia takes the nodes
    double per_dt2_ = 0.0;     ///< 0: no inertia [1/s^2]
    Stiffness stiffness_;
    double modulus_ = 0.0, radius_;  ///< largest, smallest
    double elastic_ = 0.0;
    double force_scale_ = 0.0;  ///< largest of a node by its grain alone [N]

    double hold_ = 0.0;         ///< spring of the nodes of contacts [largest modulus]
    std::vector<Vec2> step_;    ///< towards lower energy
    std::vector<Vec2> pushes_;  ///< of contacts on nodes
    std::vector<Vec2> looked_;  ///< step for touches as foreseen
    std::vector<Touch> active_, next_active_;
    Trial trial_, farther_;
};

}  // namespace softgrain::mpm
