#pragma once
// Elastic bonds between neighbouring discs of a grain, which may break.
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "common/checkpoint.hpp"
#include "common/neighbors.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

struct BondLaw {
    double stiffness = 1.0;                                     ///< force / stretch [N/m]
    double damping = 0.0;                                       ///< share of the critical damping of the pair
    double strength = std::numeric_limits<double>::infinity();  ///< largest tension [N]
    double reach = 0.0;                                         ///< largest gap of bonded discs [m]
};

/// Springs between the discs of each grain: f = k (r - r0) + c dr/dt, r0 the distance at the start. A bonded
/// pair is not in rigid contact, so that the grain can be compressed; a pair whose bond has broken is.
class Bonds {
  public:
    /// Bonds all pairs of discs of a grain with a smaller gap than law.reach. x, radius, mass, grain [n].
    Bonds(const BondLaw& law, std::span<const Vec2> x, std::span<const double> radius,
          std::span<const double> mass, std::span<const int> grain);

    /// Force on every disc [N], damping included.
    void forces(std::span<const Vec2> x, std::span<const Vec2> v, std::span<Vec2> force,
                bool threads = false) const;

    /// Elastic energy [J per unit thickness].
    double energy(std::span<const Vec2> x) const;
    /// Power that the damping takes in a step between the velocities `before`, which its forces are those
    /// of, and `after` [W per unit thickness].
    double damping_power(std::span<const Vec2> x, std::span<const Vec2> before,
                         std::span<const Vec2> after) const;

    /// Removes the bonds that are stretched beyond the strength. Returns the energy they held, < 0 if none
    /// has broken.
    double break_bonds(std::span<const Vec2> x);

    /// Bonded pairs, sorted.
    std::span<const Pair> pairs() const { return pairs_; }
    std::size_t broken() const { return made_ - pairs_.size(); }

    /// For each disc the number of its fragment within the whole sample, from 0; fragments in the order of
    /// their first disc. A grain none of whose bonds has broken is one fragment.
    std::vector<int> fragments() const;

    /// Largest time step for which the springs are stable, without damping [s].
    double stable_time_step(std::span<const double> mass) const;

    void save(Checkpoint& to, const std::string& prefix) const;
    /// Throws InputError if the stored bonds are not among those of this sample.
    void load(const Checkpoint& from, const std::string& prefix);

  private:
    struct End {
        int other;
        double rest, damping;
    };
    void list_ends();

    BondLaw law_;
    std::size_t made_ = 0;
    std::vector<Pair> pairs_;
    std::vector<double> rest_, damping_;  ///< [pairs] r0 [m], c [N s/m]
    std::vector<int> start_;              ///< [n + 1]
    std::vector<End> ends_;               ///< of each disc
};

}  // namespace softgrain::bpm
