#pragma once
// Contact dynamics of rigid discs (Moreau-Jean): one implicit step of unilateral, inelastic contact.
#include <limits>
#include <string>
#include <vector>

#include "common/box.hpp"
#include "common/checkpoint.hpp"
#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/discs.hpp"
#include "common/contact_dynamics/sweep.hpp"
#include "common/neighbors.hpp"

namespace softgrain {

struct ContactSettings {
    double tolerance = 0.0;        ///< largest change of a gap by one more sweep [m], > 0
    double skin = 0.0;             ///< candidates are pairs with a smaller gap [m], > 0
    int max_iterations = 1000;     ///< sweeps in one solve
    double over_relaxation = 1.8;  ///< 0 to 2; rows with friction use 1
    /// Friction and rolling resistance inside a group and between groups; walls have none.
    contact_sweep::Resistance within = {}, between = {};
    /// An overlap is removed by at most this much in a step [m], so that deep ones do not explode.
    double largest_push = std::numeric_limits<double>::infinity();
    int block_discs = 512;    ///< larger groups are divided
    bool heeds_stop = false;  ///< stop_request() ends a solve between sweeps, and what it has is lost
};

struct ContactResult {
    int iterations = 0;        ///< sweeps made, most of them over a part of the contacts
    double sweeps = 0.0;       ///< contacts relaxed / contacts
    double residual = 0.0;     ///< h max |dp / (omega m_e)| of the last sweep over all contacts [m]
    double penetration = 0.0;  ///< deepest overlap before the step [m]
    bool converged = false;
};

/// Finds impulses p >= 0 such that no gap is negative after x += h v, by projected over-relaxation with warm
/// start: p' = max(0, p - omega m_e (n.dv + gap/h)), t' = clamp(t - (m_e/3) v_t, +-mu p').
/// Rolling: c' = clamp(c - I_e (w_j - w_i), +-mu_r (r_i + r_j) p'). Same bits for any number of threads.
class ContactDynamics {
  public:
    explicit ContactDynamics(const ContactSettings& settings);

    /// Changes discs.v (and rim_speed) from the velocities without contact to those at the end of the step.
    /// The number, radii, masses and groups of the discs must stay the same between calls. Throws StopAsked
    /// if the settings heed a stop.
    ContactResult solve(const Discs& discs, const WallMotion& walls, double h, bool threads = false);

    /// Sorted pairs that never are in contact, from now on.
    void exclude(std::span<const Pair> pairs, const Discs& discs, const Box& box);

    /// The contacts of the last solve; impulses are `normal` and `tangential` times the reduced mass.
    const ContactRows& rows() const { return rows_; }
    const WallRows& wall_rows() const { return wall_rows_; }
    /// Reduced mass of a row between discs [kg].
    double reduced_mass(std::size_t row, std::span<const double> mass) const {
        return rows_.share[row] * mass[static_cast<std::size_t>(rows_.i[row])];
    }
    long long rebuilds() const { return rebuilds_; }

    /// Everything the next solve depends on, under names starting with `prefix`.
    void save(Checkpoint& to, const std::string& prefix) const;
    void load(const Checkpoint& from, const std::string& prefix, const Discs& discs);

  private:
    bool stale(const Discs& discs, const WallMotion& walls, double h, bool threads) const;
    void rebuild(const Discs& discs, const Box& box);
    void list_candidates(const Discs& discs, const Box& box);
    void scale_impulses(double factor);

    ContactSettings settings_;
    std::vector<Vec2> built_at_;  ///< positions of the last rebuild
    std::vector<Pair> excluded_;
    ContactBlocks blocks_;
    Box built_box_;
    ContactRows rows_;
    WallRows wall_rows_;
    double last_step_ = 0.0;  ///< h of the stored impulses, 0 before the first solve
    long long rebuilds_ = 0;
};

}  // namespace softgrain
