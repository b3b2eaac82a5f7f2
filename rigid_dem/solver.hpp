#pragma once
// Classical DEM of rigid discs (Cundall type): leap-frog, linear contacts, Coulomb friction with history.
#include "common/gather.hpp"
#include "common/neighbors.hpp"
#include "common/solver.hpp"
#include "rigid_dem/contact_law.hpp"
#include "rigid_dem/parameters.hpp"

namespace softgrain::rigid_dem {

class RigidDem final : public Solver {
  public:
    RigidDem(const Scenario& scenario, const Packing& packing);

    double stable_time_step() const override;
    void advance(const WallMotion& walls, double dt) override;
    GrainView view(Need need) override;
    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    double stress_scale() const override { return law_.young; }
    std::optional<std::string> outside_validity() const override;
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;

    /// For set-ups that start in motion [n].
    void set_velocity(std::span<const Vec2> velocity, std::span<const double> spin);
    std::span<const double> spin() const { return spin_; }

  private:
    template <bool with_friction>
    void evaluate_forces(const WallMotion& walls, double dt);
    void rebuild_neighbors();
    void account_energy(double dt);
    void measure_area();
    void list_contacts();
    void measure_stress();
    void draw_outlines();

    Parameters law_;
    Box box_;
    double time_ = 0.0;

    // grains [n]
    std::vector<double> radius_, mass_, reference_area_;
    std::vector<Vec2> x_, v_, force_;
    std::vector<double> spin_, torque_;
    std::vector<double> frequency2_;  ///< bound on omega^2 from the stiffness sum [1/s^2]

    // pairs of the neighbour list
    NeighborList neighbors_;
    PairsOfGrain pairs_of_;
    std::vector<ContactMemory> memory_;
    std::vector<Vec2> pair_force_;          ///< on i [N]
    std::vector<double> pair_shear_;        ///< tangential part, for the torque [N]
    std::vector<double> overlap_;           ///< <= 0 if apart [m]
    std::vector<double> pair_dissipation_;  ///< by sliding in the last step [J]
    std::vector<double> pair_damping_;      ///< by the dashpot in the last step [J]

    // walls: four possible contacts for each grain [4 n]
    std::vector<double> wall_normal_force_, wall_overlap_, wall_dashpot_, wall_damping_;
    std::array<Vec2, 4> wall_force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    std::array<Vec2, 4> wall_force_before_ = wall_force_;

    EnergyLedger energy_;

    // storage behind the view
    std::vector<double> area_;
    double covered_area_ = 0.0;
    std::vector<GrainContact> contacts_;
    std::vector<Mat2> stress_;
    std::vector<int> outline_offset_;
    std::vector<Vec2> outline_point_;
};

}  // namespace softgrain::rigid_dem
