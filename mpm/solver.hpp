#pragma once
// The material point method as a Solver: grains resolved as continua, in equilibrium between walls.
#include <array>
#include <limits>
#include <string>
#include <vector>

#include "common/solver.hpp"
#include "mpm/dynamics/explicit_motion.hpp"
#include "mpm/equilibrium.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

enum class Driver { quasi_static, implicit, explicit_steps };

/// Values of the scenario table [mpm]; see mpm/method.cpp for units and defaults.
struct MpmSettings {
    LawKind law;
    Driver driver;
    int cells;           ///< of a grain's grid, across its radius
    double strain_step;  ///< largest strain of the box in a step of the implicit drivers
    double time_step;    ///< largest of implicit dynamics [radius of the smallest grain / sqrt(E/rho)]
    EquilibriumSettings equilibrium;
    ExplicitSettings motion;
};

/// Reads the table [mpm] of a scenario, defaults where there is none.
MpmSettings settings_of(const Scenario& scenario);

/// quasi_static: time is only what the walls move by; each step ends in equilibrium. implicit: Euler's
/// implicit method, which is equilibrium with inertia. Both in as many smaller steps as it takes. explicit:
/// leap-frog.
class MpmSolver final : public Solver {
  public:
    /// Throws InputError if the packing has no grains, DivergedError if its overlaps cannot be resolved.
    MpmSolver(const Scenario& scenario, const Packing& packing);

    /// The time in which the walls strain the box by a strain_step; infinite if they stand.
    double stable_time_step() const override;
    /// Throws DivergedError if there is no equilibrium even for the smallest part of the step; heeds a stop
    /// between the iterations of an implicit one.
    void advance(const WallMotion& walls, double dt) override;
    GrainView view(Need need) override;
    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    double stress_scale() const override { return stress_scale_; }
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;

    const Grains& grains() const { return grains_; }
    std::span<const Vec2> nodes() const { return q_; }
    /// Of Newton's method, since the start.
    long long iterations() const { return iterations_; }

  private:
    void make_grains(const Scenario& scenario, const Packing& packing);
    void make_step(const WallMotion& walls, double dt);
    void advance_explicitly(const WallMotion& walls, double dt);
    void advance_implicitly(const WallMotion& walls, double dt);
    const Contacts& contacts() const { return motion_ ? motion_->contacts() : equilibrium_->contacts(); }
    const Surfaces& surfaces() const { return motion_ ? motion_->surfaces() : equilibrium_->surfaces(); }
    const Friction& friction() const { return motion_ ? motion_->friction() : equilibrium_->friction(); }
    std::vector<PlasticState>& plastic() const { return motion_ ? motion_->plastic : equilibrium_->plastic; }
    /// From the box as it is to another, in dt. False, and nothing has changed, if no equilibrium was found.
    bool move_walls(const Box& to, double dt, EquilibriumResult& result);
    /// Throws DivergedError if the grains could not be in it.
    void check_room(const Box& box, double dt) const;
    void evaluate();
    void flow();
    void find_centroids();
    void find_energy();
    double kinetic_energy() const;
    double work_of_gravity() const;
    void view_stress();
    void view_outlines();
    void view_parts(GrainView& view);
    double covered_area() const;
    double stored_energy();
    double dissipated_by_flow() const;

    MpmSettings settings_;
    Grains grains_;
    std::unique_ptr<Equilibrium> equilibrium_;  ///< of the implicit drivers
    std::unique_ptr<ExplicitMotion> motion_;    ///< of the explicit one
    std::unique_ptr<GrainForces> forces_;       ///< for views
    std::vector<Vec2> q_;                       ///< [grains * nodes] coefficients of positions [m]
    std::vector<Vec2> v_;                       ///< and of velocities; zero without dynamics [m/s]
    std::vector<Vec2> force_;
    double stress_scale_ = 0.0;
    double crossing_ = std::numeric_limits<double>::infinity();  ///< least radius / sqrt(E/rho) [s]

    double time_ = 0.0;
    double strain_rate_ = 0.0;  ///< of the box in the last step, of its faster axis [1/s]
    Box box_;
    std::array<Vec2, 4> wall_force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    EnergyLedger energy_;
    double iterations_of_step_ = 0.0;
    long long iterations_ = 0;

    // What view() hands out.
    std::vector<Vec2> placed_;  ///< [grains] centroids in the packing
    std::vector<Vec2> centroid_, velocity_, outline_point_, part_position_, part_reference_;
    std::vector<double> mass_, reference_area_, area_, part_radius_, von_mises_, pressure_, part_deformation_,
        plastic_strain_, residual_of_grain_;
    std::vector<int> outline_offset_, part_grain_;
    std::vector<GrainContact> contact_;
    std::vector<Mat2> stress_;
};

}  // namespace softgrain::mpm
