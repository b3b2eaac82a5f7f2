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
    Mat2 cell_stress() const override { return cell_virial_ / box_.area(); }
    double stress_scale() const override { return mean_modulus_; }
    std::optional<std::string> outside_validity() const override;
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;

    /// For set-ups that start in motion [n].
    void set_velocity(std::span<const Vec2> velocity, std::span<const double> spin);
    std::span<const double> spin() const { return spin_; }

  private:
    /// `walls` at the end of the step.
    void evaluate_forces(const WallMotion& walls, double dt);
    template <bool with_friction>
    void evaluate_pairs(const WallMotion& walls, double dt);
    template <bool with_friction>
    void gather_forces(const WallMotion& walls, double dt);
    void carry_along(const WallMotion& walls);
    void wrap(const WallMotion& walls);
    void list_neighbors();
    void sum_virial();
    Vec2 branch(std::size_t pair) const;
    Mat2 kinetic_tensor(double dt) const;
    void account_energy(double dt);
    void measure_area();
    void list_contacts();
    void measure_stress();
    void draw_outlines();

    Parameters law_;
    Box box_;           ///< as the loop moves it
    WallMotion walls_;  ///< of the last step, its box at the end of it
    int flips_ = 0;     ///< of a periodic cell's basis against box_
    double time_ = 0.0;
    double mean_modulus_ = 0.0, largest_stiffness_ = 0.0;

    // grains [n]
    std::vector<double> radius_, mass_, reference_area_;
    std::vector<double> stiffness_;  ///< at a rigid wall [N/m]
    std::vector<Vec2> x_, v_, force_;
    std::vector<double> spin_, torque_;
    std::vector<double> frequency2_;  ///< bound on omega^2 from the stiffness sum [1/s^2]

    // pairs of the neighbour list
    NeighborList neighbors_;
    PairsOfGrain pairs_of_;
    std::vector<ContactMemory> memory_;
    std::vector<double> pair_stiffness_;    ///< [N/m]
    std::vector<Vec2> pair_force_;          ///< on i [N]
    std::vector<double> pair_shear_;        ///< tangential part, for the torque [N]
    std::vector<double> overlap_;           ///< <= 0 if apart [m]
    std::vector<double> pair_dissipation_;  ///< by sliding in the last step [J]
    std::vector<double> pair_damping_;      ///< by the dashpot in the last step [J]

    // walls: four possible contacts for each grain [4 n]
    std::vector<double> wall_normal_force_, wall_overlap_, wall_dashpot_, wall_damping_;
    std::array<Vec2, 4> wall_force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    std::array<Vec2, 4> wall_force_before_ = wall_force_;

    // periodic cell
    Mat2 cell_virial_ = Mat2::Zero();     ///< -sum of force (x) branch [N m]
    Mat2 kinetic_tensor_ = Mat2::Zero();  ///< sum of m c (x) c, c against the flow of the cell [J]

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
