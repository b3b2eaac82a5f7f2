#pragma once
// SDEM: discs with six degrees of freedom, the centre c and the deformation gradient F. See README.md.
// solver.cpp: one step. solver_rest.cpp: grains left out. The other files: as they say.
#include <array>
#include <memory>
#include <vector>

#include "common/resting_blocks.hpp"
#include "common/solver.hpp"
#include "common/thread_choice.hpp"
#include "sdem/chunks.hpp"
#include "sdem/contact_list.hpp"
#include "sdem/geometry/clipped_ellipse.hpp"
#include "sdem/grain_motion.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/pressures.hpp"
#include "sdem/sliding.hpp"

namespace softgrain::sdem {

/// Grains whose contacts and pressures are found in one go, as many as a core's own cache holds. They rest
/// together.
inline constexpr std::size_t grains_per_part = 8 * grains_per_block;

/// What a run of this method can choose.
struct Options {
    MotionLaw motion;
    Geometry geometry = Geometry::batch;
    SlidingLaw sliding;
    double contact_damping = 1.0;  ///< gamma of Eq. 61
    double safety = 0.8;           ///< time step / stability limit
    double skin = 0.2;             ///< of the neighbour list, in mean radii
    double rest_tolerance = 0.0;   ///< RestingBlocks', in mean radii
    int outline_points = 64;
};

class SoftDiscSolver : public Solver {
  public:
    SoftDiscSolver(std::vector<GrainMaterial> material, const Packing& packing, const Options& options);

    double stable_time_step() const override { return time_step_; }
    void advance(const WallMotion& walls, double dt) override;
    GrainView view(Need need) override;
    const std::array<Vec2, 4>& wall_force() const override { return wall_force_; }
    Mat2 cell_stress() const override { return cell_stress_.total; }
    double stress_scale() const override;
    std::optional<std::string> outside_validity() const override;
    void check_finite() const override;
    void save(Checkpoint& to) const override;
    void load(const Checkpoint& from) override;
    /// What a step leaves out.
    const RestingBlocks& rest() const { return rest_; }

  protected:
    /// Contacts and forces at the present positions; `dt` is the step that led there, 0 if none did.
    void update_contacts(double dt);
    /// The same, with new candidates where the old ones have had their day.
    void refresh_contacts(double dt);
    void throw_bad_grain(std::size_t g) const;
    double time_step_limit();
    /// Elastic energy of the grains, and with that of springs and adhesion [J].
    double grain_energy() const;
    double potential_energy() const;
    /// Against gravity, from the origin [J].
    double height_energy() const;
    bool threads_pay_off() const { return threads_.parallel(); }
    /// The cell or the walls at their present place, on the lattice that the contact list was made for.
    WallMotion cell() const { return motion_.flipped(flips_); }
    ContactView contact_view() const { return {contacts_, grains_.center, lattice_}; }
    ForceSource forces() const;
    MotionInput motion_input() const;
    bool has_potential() const { return options_.motion.contact_law == ContactLaw::lens_potential; }
    std::size_t size() const { return grains_.size(); }
    Chunks blocks() const { return {size(), grains_per_block}; }
    Chunks parts() const { return {size(), grains_per_part}; }
    int packing_index(std::size_t g) const { return grains_.original[g]; }

    Options options_;
    Grains grains_;
    GrainMemory memory_;
    ContactList contacts_;
    Pressures pressures_;
    WallMotion motion_;  ///< the box now, and how it last moved
    Box lattice_;        ///< the box now, on the lattice of the contact list
    double time_ = 0.0;
    double lag_ = 0.0;  ///< by how much velocities are behind positions: half a step [s]
    std::array<Vec2, 4> wall_force_{};
    double height_energy_at_start_ = 0.0;  ///< [J]
    ThreadChoice threads_;
    EnergyLedger
        ledger_;  ///< up to half a step before now; kinetic not used, elastic only without a potential

  private:
    void place(const Packing& packing);
    void rebuild_contacts();
    void find_contacts();
    void find_forces(double dt);
    void sum_wall_forces();
    struct CellStress {
        Mat2 total = Mat2::Zero(), damping = Mat2::Zero();
    };
    void add_stress(CellStress& sum, std::size_t k) const;
    void add_boundary_work(EnergyLedger& ledger, const WallMotion& walls, const Tensor& flux,
                           double dt) const;
    double time_step_share() const;
    void limit_time_step(double dt);
    void heed_closed_contacts();
    /// What contacts do to the largest stable step of a grain.
    struct Restraint {
        double stiffness = 0.0;  ///< [N/m]
        double viscosity = 0.0;  ///< [kg/s]

        void add(const Restraint& other) {
            stiffness += other.stiffness;
            viscosity += other.viscosity;
        }
    };
    double grain_time_step(std::size_t g, const Restraint& contacts) const;
    double resistance(std::size_t g, double overlap) const;
    Restraint pair_restraint(std::size_t k) const;
    Restraint wall_restraint(std::size_t w) const;
    Restraint pair_restraint(std::size_t k, double resistance_i, double resistance_j) const;
    Restraint wall_restraint(std::size_t w, double resistance) const;
    Restraint restraint_of(const Contact& c, double resistance, double part, double E,
                           double reduced_mass) const;
    void throw_bad_pair(const BadPair& bad) const;

    // rest
    bool block_rests(std::size_t block) const {
        return rest_.resting(block * grains_per_block / grains_per_part);
    }
    void start_rest();
    bool is_pushed(std::size_t part, const WallMotion& walls) const;
    void wake_pushed(const WallMotion& walls);
    void wake_touched(double dt);
    bool is_balanced(std::size_t part, double largest_acceleration) const;
    void put_to_rest(const WallMotion& walls, double dt);
    StepWork come_to_rest(std::size_t part);
    void save_rest(Checkpoint& to) const;
    void load_rest(const Checkpoint& from);
    /// visit(push, contact) for each candidate contact of a part's grains.
    template <class Self, class Visit>
    static void each_push(Self& solver, std::size_t part, const Visit& visit);
    /// visit(value) for all that a part at rest keeps and a new evaluation would find with other bits.
    template <class Self, class Visit>
    static void each_kept_value(Self& solver, const Visit& visit);
    /// visit(begin, end) for the stretches of the contacts [begin, end) that are not left out. grain_of(k):
    /// the grain with which contact k is kept; first(g): the first contact kept with grain g.
    template <class GrainOf, class First, class Visit>
    void each_awake_stretch(std::size_t begin, std::size_t end, const GrainOf& grain_of, const First& first,
                            const Visit& visit) const;

    EnergyLedger energy() const;
    /// Overlaps that grain g gives way to, and its area ratio Je under them; lens potential only.
    LensPotential::Sums overlaps(std::size_t g) const;
    double area_ratio(std::size_t g, const LensPotential::Sums& contacts) const;
    /// Every now and then: throws DivergedError if energy has come from nowhere since the last time.
    void watch_energy();

    void fill_state();
    void fill_areas();
    void fill_contacts();
    void fill_stress();
    void fill_outlines();
    void fill_fields();
    std::vector<Cut> cuts_of(std::size_t g) const;

    RestingBlocks rest_;     ///< parts
    SideValues resistance_;  ///< if parts may rest: these keep their pushes
    int flips_ = 0;
    double skin_ = 0.0;                                     ///< of the neighbour list [m]
    double time_step_ = 0.0;                                ///< [s] found every few steps
    std::vector<Restraint> restraint_;                      ///< [n] when last looked at
    std::vector<std::size_t> closed_pairs_, closed_walls_;  ///< in this step
    long long steps_ = 0;
    std::vector<ChordGuess> guess_before_;  ///< [pairs] before the last evaluation
    struct Balance {
        double energy = 0.0;  ///< kinetic + elastic + dissipated - external work [J]
        double held = 0.0;    ///< kinetic + elastic [J]
        double external_work = 0.0;
        bool watched = false;
    } balance_;  ///< when the energy was last watched
    std::array<Vec2, 4> wall_damping_force_{};
    CellStress cell_stress_;

    struct ViewData {
        std::vector<Vec2> center, velocity;
        std::vector<double> mass, reference_area;
        std::vector<double> area, clipped_area, strain_1, strain_2, cap_fraction, covered_outline, F, radius,
            plastic_strain, grain_class;
        std::vector<GrainContact> contacts;
        std::vector<Mat2> stress;
        std::vector<int> outline_offset;
        std::vector<Vec2> outline_point;
        std::vector<std::size_t> place;  ///< [n] where the packing's grain is kept
        double covered_area = 0.0;
    } view_;
};

}  // namespace softgrain::sdem
