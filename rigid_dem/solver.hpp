#pragma once
// Classical DEM of rigid discs (Cundall type): leap-frog, compliant contacts with memory.
// solver.cpp: one step. listing.cpp: neighbours, blocks, memory of contacts. time_step.cpp: the stability
// limit. rest.cpp: blocks left out. driven.cpp, periodic_cell.cpp, energy.cpp, view.cpp, checkpoint.cpp: as
// they say. With clumps,
// everything here counts discs, and what moves and what the view tells are the clumps (clumps.hpp).
#include <algorithm>
#include <memory>
#include <utility>

#include "common/neighbors.hpp"
#include "common/resting_blocks.hpp"
#include "common/solver.hpp"
#include "common/thread_choice.hpp"
#include "rigid_dem/blocks.hpp"
#include "rigid_dem/clumps.hpp"
#include "rigid_dem/motion_kernel.hpp"
#include "rigid_dem/parameters.hpp"
#include "rigid_dem/wall_contacts.hpp"

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

    /// For set-ups that start in motion [n], half a step back.
    void set_velocity(std::span<const Vec2> velocity, std::span<const double> spin);
    /// [n] [1/s].
    std::span<const double> spin();
    /// What contacts see: the grains, or the discs of clumps, those of grain 0 first.
    std::vector<Disc> discs() const;
    /// Neighbour lists made so far.
    int listings() const { return listings_; }
    /// What a step leaves out.
    const RestingBlocks& rest() const { return rest_; }

  private:
    /// Of a block's contacts in a step.
    struct BlockTotals {
        Mat2 virial = Mat2::Zero();
        double friction_loss = 0.0, damping_loss = 0.0, adhesion_loss = 0.0, overlap = 0.0;
        std::array<Vec2, 4> wall_force{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    };
    struct ContactBook;
    struct StiffnessSum;

    // one step
    void move(const WallMotion& walls, double dt);
    void evaluate_forces(const WallMotion& walls, double dt);
    BlockTotals contact_forces(std::size_t block, const WallMotion& cell, double dt);
    void refresh_copies(const Block& block, const WallMotion& cell);
    void start_with_weight(const Block& block);
    void collect_arrivals(const Block& block);
    void throw_too_fast(const WallMotion& walls, double dt) const;
    bool threads() const;
    std::size_t mover_blocks() const;
    MotionBlock movers(std::size_t block);

    // neighbours and blocks
    bool list_is_stale();
    void list_again();
    void list_neighbors(std::vector<Vec2> x);
    void require_room_for_clumps() const;
    void set_motion(const std::vector<GrainMotion>& motion);
    std::vector<int> places_in_space() const;
    double sorting_cell() const;
    void prepare_pairs(Block& block) const;
    void fill_block(std::size_t block);
    void list_walls(std::size_t block);
    ContactBook open_book() const;
    bool forgets(const Block& block, std::size_t pair) const;
    void copy_memory(const ContactBook& book, std::size_t block);
    void remember(const std::vector<double>& memory, const std::vector<double>& at_walls);
    double skin_by_motion() const;
    double reach_of(std::size_t grain) const;
    Deformation deformation_since_listing(double& loss) const;

    // rest
    void start_rest();
    bool is_pushed(std::size_t block, const WallMotion& walls) const;
    void wake_pushed(const WallMotion& walls);
    void wake_touched(double dt);
    bool is_balanced(const Block& block, double largest_acceleration) const;
    void put_to_rest(const WallMotion& walls, double dt);
    std::vector<double> kept_at_rest() const;
    void set_kept_at_rest(const std::vector<double>& kept);
    /// visit(value) for all that a block at rest keeps and a new evaluation would find with other bits.
    template <class Self, class Visit>
    static void each_kept_value(Self& solver, const Visit& visit);

    // driven grains
    std::size_t free_grains() const { return reference_area_.size() - driven_.size(); }
    /// Never a disc of a clump: there are no driven grains beside clumps.
    bool is_driven(std::size_t grain) const { return !driven_.empty() && grain >= free_grains(); }
    void start_driven();
    void move_driven(double time, double dt);
    void take_driven_forces();
    double driven_work(const std::vector<ForceSum>& force, double dt) const;

    // time step
    void find_frequency();
    double frequency2_of_clumps() const;
    void sum_stiffness(std::size_t block, StiffnessSum* stiffness) const;
    double stiffness_soon(std::size_t grain, double mass) const;
    double tangent_stiffness(double k, double overlap) const;

    // periodic cell
    Flow flow_of(const WallMotion& walls) const;
    void carry_along(const WallMotion& walls);
    void wrap(const WallMotion& walls);
    Mat2 kinetic_tensor(double dt);

    // energy
    EnergyLedger energy() const;
    double height_energy() const;

    // view
    void sort_by_grain();
    Vec2 home_of(std::size_t disc) const;
    void measure_area();
    void list_contacts();
    void name_clumps();
    void measure_stress();
    void draw_outlines();

    /// visit(i, j, pair) for each pair of a block, grains by number.
    template <class Visit>
    void each_pair(const Block& block, const Visit& visit) const;
    /// visit(grain, record) in spatial order.
    template <class Visit>
    void each_grain(const Visit& visit) const;
    /// visit(grain, record, force) for all that move: grains in spatial order, or clumps by number.
    template <class Visit>
    void each_mover(const Visit& visit) const;
    template <class Visit>
    void each_mover(const Visit& visit);
    /// Number in the view.
    std::size_t owner(std::size_t grain) const { return clumps_ ? clumps_->owner(grain) : grain; }
    const GrainRecord& record(const Block& block, std::size_t local) const {
        return record_[block.first_record + local];
    }
    double overlap(const Block& block, std::size_t pair) const;
    /// That a grain's record is in.
    std::size_t block_of(std::size_t record) const {
        const auto after = std::upper_bound(blocks_.begin(), blocks_.end(), record,
                                            [](std::size_t r, const Block& b) { return r < b.first_record; });
        return static_cast<std::size_t>(after - blocks_.begin()) - 1;
    }
    std::size_t record_of(std::size_t place) const {
        const std::size_t each = blocks_.front().grains;
        return blocks_[place / each].first_record + place % each;
    }
    ContactStiffness stiffness_of(const Block& block, std::size_t pair) const;
    ContactMemory memory_of(const Block& block, std::size_t pair) const;
    ContactForce pair_force(const Block& block, std::size_t pair) const;
    std::size_t grain_of(const Block& block, const WallContact& contact) const {
        return order_[block.first_grain + contact.record - block.first_record];
    }

    Parameters law_;
    PairKernel kernel_;
    WallKernel wall_kernel_;
    bool uniform_;                         ///< all pairs are equally stiff
    Box box_;                              ///< as the loop moves it
    WallMotion walls_;                     ///< of the last step, its box at the end of it
    Vec2 gravity_;                         ///< [m/s^2]
    double height_energy_at_start_ = 0.0;  ///< [J]
    int flips_ = 0;                        ///< of a periodic cell's basis against box_
    double time_ = 0.0, last_dt_ = 0.0;
    double mean_modulus_ = 0.0;

    std::unique_ptr<Clumps> clumps_;  ///< null if all grains are discs

    // grains by number [n], or their discs
    std::vector<double> radius_, mass_;   ///< of a disc of a clump: the mass that contacts see
    std::vector<double> reference_area_;  ///< of grains
    double smallest_radius_ = 0.0, largest_radius_ = 0.0;  ///< [m]
    std::vector<std::uint8_t> grain_class_;                ///< empty if there is one
    std::vector<Material> material_;                       ///< by class
    GrainElasticity elasticity_of(std::size_t grain) const;

    // grains by record: blocks with their copies
    std::vector<std::uint32_t> order_;  ///< grain by place in spatial order [n]
    std::vector<Block> blocks_;
    std::vector<std::vector<WallContact>> wall_contacts_;  ///< by block
    std::vector<GrainRecord> record_;
    std::vector<ForceSum> force_;
    std::vector<BlockTotals> totals_;  ///< by block, of the last step
    RestingBlocks rest_;

    // driven grains, the last ones by number
    std::vector<DrivenMotion> driven_;
    std::vector<Vec2> driven_start_;  ///< [m]
    std::vector<std::size_t> driven_record_;
    std::vector<ForceSum> driven_force_;  ///< by grains, after the last step

    // neighbour list
    NeighborList neighbors_{true};
    double skin_ = 0.0;
    int listings_ = 0;
    double travelled_ = 0.0;        ///< bound on motion against the flow since the listing [m]
    long long steps_listed_ = 0;    ///< steps since then
    long long steps_measured_ = 0;  ///< since the last look at the frequency
    double frequency2_ = 0.0;       ///< bound on omega^2 [1/s^2]
    double fastest2_ = 0.0;         ///< squared speed against the flow in the last step [m^2/s^2]
    ThreadChoice thread_choice_;

    // sums of the last step
    std::array<Vec2, 4> wall_force_{Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), Vec2::Zero()};
    Mat2 cell_virial_ = Mat2::Zero();     ///< -sum of force (x) branch [N m]
    Mat2 kinetic_tensor_ = Mat2::Zero();  ///< sum of m c (x) c, c against the flow of the cell [J]
    double largest_overlap_ = 0.0;        ///< [m]
    EnergyLedger dissipated_;             ///< and external work; the rest is found on demand

    // storage behind the view, by grain
    std::vector<Vec2> x_, v_;
    std::vector<double> spin_;
    std::vector<double> area_;
    double covered_area_ = 0.0;
    std::vector<GrainContact> contacts_;
    std::vector<Mat2> stress_;
    std::vector<int> outline_offset_;
    std::vector<Vec2> outline_point_;
};

template <class Visit>
void RigidDem::each_pair(const Block& block, const Visit& visit) const {
    // A copy's grain: the record it copies lies in its block at this place.
    const auto grain_of = [&](std::size_t local) -> std::size_t {
        if (local < block.grains) return order_[block.first_grain + local];
        const std::uint32_t record = block.halo[local - block.grains].record;
        const Block& home = blocks_[block_of(record)];
        return order_[home.first_grain + record - home.first_record];
    };
    for (std::size_t k = 0; k < block.pairs.size(); ++k) {
        const std::size_t i = block.pairs[k].i, j = block.pairs[k].j;
        visit(grain_of(i), grain_of(j), k);
    }
}

template <class Visit>
void RigidDem::each_mover(const Visit& visit) const {
    if (clumps_)
        for (std::size_t g = 0; g < clumps_->size(); ++g)
            visit(g, std::as_const(*clumps_).bodies()[g], clumps_->forces()[g]);
    else
        each_grain([&](std::size_t grain, std::size_t r) { visit(grain, record_[r], force_[r]); });
}

template <class Visit>
void RigidDem::each_mover(const Visit& visit) {
    if (clumps_)
        for (std::size_t g = 0; g < clumps_->size(); ++g)
            visit(g, clumps_->bodies()[g], clumps_->forces()[g]);
    else
        each_grain([&](std::size_t grain, std::size_t r) { visit(grain, record_[r], force_[r]); });
}

template <class Visit>
void RigidDem::each_grain(const Visit& visit) const {
    for (const Block& block : blocks_)
        for (std::size_t g = 0; g < block.grains; ++g)
            visit(static_cast<std::size_t>(order_[block.first_grain + g]), block.first_record + g);
}

}  // namespace softgrain::rigid_dem
