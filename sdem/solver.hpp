#pragma once
// SDEM: discs with six degrees of freedom, the centre c and the deformation gradient F. See README.md.
#include <array>
#include <cstdint>
#include <vector>

#include "common/gather.hpp"
#include "common/neighbors.hpp"
#include "common/solver.hpp"
#include "sdem/contact_forces.hpp"
#include "sdem/geometry/clipped_ellipse.hpp"
#include "sdem/geometry/ellipse.hpp"
#include "sdem/kinematics.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {

/// What a run of this method can choose.
struct Options {
    Kinematics kinematics = Kinematics::D2F3;
    bool incompressible = false;
    double safety = 0.8;         ///< share of the stability limit
    double shape_damping = 0.5;  ///< in sqrt(E/rho)/R
    double skin = 0.2;           ///< of the neighbour list, in mean radii
    int outline_points = 64;
};

/// State of the grains, structure of arrays [n].
struct Grains {
    std::vector<double> radius, mass, inertia;  ///< [m], [kg], M = rho pi R^4/4 [kg m^2]
    std::vector<double> reference_area;         ///< A0 = pi R^2 [m^2]
    std::vector<Vec2> position, velocity;       ///< c [m], c' [m/s]
    std::vector<Mat2> F, F_rate;                ///< F [-], F' [1/s]
};

class SoftDiscSolver final : public Solver {
  public:
    SoftDiscSolver(const Material& material, const Packing& packing, const Mollon2022& law,
                   const Options& options);

    double stable_time_step() const override;
    void advance(const WallMotion& walls, double dt) override;
    GrainView view(Need need) override;
    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    double stress_scale() const override { return law_.E; }
    std::optional<std::string> outside_validity() const override;
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;

  private:
    /// New velocity and rate of one grain after `dt` under the stored forces, and the work done on the way.
    struct Kick {
        Vec2 velocity;
        Mat2 F_rate;
        double stored, damped;  ///< [J]
    };
    template <class MotionPolicy>
    Kick kick(std::size_t g, double dt) const;
    template <class MotionPolicy>
    void move(double dt);
    template <class MotionPolicy>
    EnergyLedger energy_now() const;
    EnergyLedger energy() const;
    template <class Function>
    decltype(auto) with_motion(Function&& function) const;

    void update_shapes(std::span<const Vec2> before);
    void update_neighbors();
    void rebuild_neighbors();
    void evaluate_forces();
    void evaluate_pairs();
    bool add_walls(std::size_t g, GrainForces& sum);
    void add_pairs(std::size_t g, GrainForces& sum) const;
    void add_inner_stress(std::size_t g, GrainForces& sum) const;
    void sum_wall_forces();
    void throw_bad_contact(std::size_t pair) const;
    void add_wall_work(EnergyLedger& ledger, const std::array<double, 4>& wall_velocity, double dt) const;

    void fill_areas();
    void fill_contacts();
    void fill_stress();
    void fill_outlines();
    void fill_fields();
    std::vector<Cut> cuts_of(std::size_t g) const;

    Moving moving(std::size_t g) const {
        return {shape_[g], grains_.velocity[g], grains_.F_rate[g], grains_.mass[g]};
    }
    std::size_t size() const { return grains_.radius.size(); }

    Options options_;
    double density_;
    Mollon2022 law_;
    Grains grains_;
    double time_ = 0.0;
    double last_step_ = 0.0;  ///< [s]; 0 before the first step
    Box box_;
    std::array<double, 4> wall_velocity_{};

    // Found again from the state above by update_shapes() and evaluate_forces().
    std::vector<Ellipse> shape_;
    std::vector<double> reach_;
    NeighborList neighbors_;
    PairsOfGrain pairs_of_;
    std::vector<WarmStart> warm_, warm_before_;  ///< [pairs] after and before the last evaluation
    std::vector<PairContact> pair_contact_;      ///< [pairs]
    std::vector<WallContact> wall_contact_;      ///< [4 n], valid where wall_mask_ tells
    std::vector<std::uint8_t> wall_mask_;        ///< [n], bit w set if the grain touches wall w
    std::vector<GrainForces> forces_;            ///< [n]
    std::array<Vec2, 4> wall_force_{}, wall_damping_force_{};

    EnergyLedger ledger_;                  ///< up to half a step before now; kinetic not used
    std::vector<double> stored_, damped_;  ///< [n] work of the last step
    std::vector<double> caps_before_;      ///< [n] cap fraction one evaluation ago
    std::vector<Vec2> before_;             ///< [n] positions before the last step

    struct ViewData {
        std::vector<double> area, strain_1, strain_2, cap_fraction, covered_outline, F;
        std::vector<GrainContact> contacts;
        std::vector<Mat2> stress;
        std::vector<int> outline_offset;
        std::vector<Vec2> outline_point;
        double covered_area = 0.0;
    } view_;
};

}  // namespace softgrain::sdem
