#pragma once
// The bonded-particle method as a Solver: every grain is an aggregate of rigid discs.
#include <array>
#include <optional>
#include <vector>

#include "bpm/attraction.hpp"
#include "bpm/bonds.hpp"
#include "bpm/box2d_contacts.hpp"
#include "bpm/disc_contacts.hpp"
#include "bpm/disc_sizes.hpp"
#include "bpm/grain_contacts.hpp"
#include "common/contact_dynamics/contact_dynamics.hpp"
#include "common/observables/affine_fit.hpp"
#include "common/solver.hpp"
#include "common/thread_choice.hpp"

namespace softgrain::bpm {

/// What holds the discs of a grain together: attraction (plastic), or bonds that stay or break.
enum class GrainBehaviour { plastic, elastic, brittle };

/// What solves the contacts: ContactDynamics, or Box2D.
enum class Engine { nscd, box2d };

/// Values of the scenario table [bpm]; see bpm/method.cpp for units and defaults.
struct BpmSettings {
    Engine engine;
    GrainBehaviour behaviour;
    int discs_per_grain;
    std::optional<double> disc_diameter;  ///< [m], replaces discs_per_grain
    DiscSizes disc_sizes;
    double attraction_stress;    ///< `F0 / <a0>` [N/m]
    double attraction_exponent;  ///< gamma
    double attraction_range;     ///< largest gap [a0]
    double tolerance;            ///< [mean disc diameters]
    double step;                 ///< time step / sqrt(m d / F0)
    double placing_step;         ///< the same while the grains are placed
    int max_iterations;
    double over_relaxation;
    double outline_rho;     ///< [mean disc diameters]
    double bond_stiffness;  ///< [N/m]
    double bond_strength;   ///< largest tension / mean disc diameter [N/m]
    double bond_damping;    ///< share of the critical damping
    double bond_reach;      ///< [mean disc diameters]
    double friction_within;
    double rolling_resistance;
    int velocity_iterations, position_iterations;  ///< of Box2D

    /// Stress that forces scale with: `F0/<a0>`, or the stiffness of the bonds [N/m].
    double stress_scale() const {
        return behaviour == GrainBehaviour::plastic ? attraction_stress : bond_stiffness;
    }
};

/// Reads the table [bpm] of a scenario, defaults where there is none.
BpmSettings settings_of(const Scenario& scenario);

class BpmSolver final : public Solver {
  public:
    /// Prepares the aggregates, puts them in place of the packing's discs and removes the overlaps of their
    /// rough outlines. Throws InputError if they do not fit, DivergedError if a preparation fails.
    BpmSolver(const Scenario& scenario, const Packing& packing);

    double stable_time_step() const override { return time_step_; }
    void advance(const WallMotion& walls, double dt) override;
    GrainView view(Need need) override;
    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    double stress_scale() const override { return settings_.stress_scale(); }
    std::optional<std::string> outside_validity() const override;
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;

    std::span<const Vec2> disc_position() const { return x_; }
    std::span<const double> disc_radius() const { return radius_; }
    std::span<const int> grain_start() const { return grain_start_; }
    double mean_disc_diameter() const { return diameter_; }
    double maximum_force() const { return maximum_force_; }
    const ContactResult& last_contact_result() const { return contact_result_; }
    const Bonds* bonds() const { return bonds_ ? &*bonds_ : nullptr; }
    /// Largest overlap of two discs or of disc and wall before the last step [mean disc diameters].
    double penetration() const { return penetration_; }
    /// What Box2D gave the discs by moving them apart, against their attraction [J].
    double correction_energy() const { return correction_energy_; }

  private:
    struct Assembly {
        std::vector<int> grain_start;
        std::vector<Vec2> x;
        std::vector<double> radius, mass, reference_area, internal_packing_fraction;
    };
    static Assembly assemble(const Scenario& scenario, const Packing& packing, const BpmSettings& settings);
    BpmSolver(const Scenario& scenario, const Packing& packing, const BpmSettings& settings,
              Assembly assembly);

    Discs discs() { return {x_, radius_, mass_, grain_, v_, rim_speed_}; }
    std::size_t grains() const { return grain_start_.size() - 1; }
    void place(const Box& box, double h);
    void draw_together(const Box& box, double h);
    void step_at_rest(const Box& box, double h);
    void stop_discs();
    void come_to_rest(const Box& box, double h);
    void break_bonds();
    void note_convergence();
    double inner_energy();
    double work_of_gravity() const;
    double time_step(double step) const;
    SolvedContacts solved_contacts() const;
    void step(const WallMotion& walls, double h);
    void account(const WallMotion& walls, double h);
    void watch(double h, double largest_move) const;
    double kinetic_energy() const;

    void view_grains();
    double count_fragments();
    double count_lost_discs();
    void view_outlines(Need need, GrainView& view);
    void view_fields(GrainView& view);
    void view_parts(GrainView& view);
    AffineFit motion_of(std::size_t grain) const;

    BpmSettings settings_;
    bool rubs_;                     ///< there is friction somewhere
    std::vector<int> grain_start_;  ///< [grains + 1] first disc of each grain
    std::vector<int> grain_;        ///< [discs]
    std::vector<Vec2> x_, v_, force_, v_before_;
    std::vector<Vec2> x_before_;  ///< with Box2D only
    std::vector<double> radius_, mass_, rim_speed_, rim_speed_before_;
    double diameter_, maximum_force_, time_step_;
    Attraction attraction_;
    std::optional<Bonds> bonds_;  ///< instead of the attraction
    ContactDynamics contacts_;
    std::optional<Box2dContacts> box2d_;  ///< instead of contacts_, once the grains are placed
    ThreadChoice threads_;

    double time_ = 0.0;
    Box box_;
    Vec2 gravity_ = Vec2::Zero();  ///< none while the grains are placed [m/s^2]
    double last_step_ = 0.0;
    std::array<Vec2, 4> wall_force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    EnergyLedger energy_;
    double correction_energy_ = 0.0;
    double potential_at_start_ = 0.0;
    ContactResult contact_result_;
    long long steps_ = 0, unconverged_steps_ = 0;
    double penetration_ = 0.0;

    // What view() hands out.
    std::vector<Vec2> centroid_, velocity_, outline_point_;
    std::vector<double> grain_mass_, reference_area_, area_, disc_count_, grain_penetration_;
    std::vector<double> internal_packing_fraction_, fragment_, fragments_of_grain_;
    std::vector<int> outline_offset_;
    GrainContacts grain_contacts_;
    DiscContacts disc_contacts_;
    std::vector<Vec2> x_start_;  ///< [discs] positions at the start of the run
    std::vector<double> deformation_, non_affine_motion_, non_affine_displacement_;
};

}  // namespace softgrain::bpm
