#pragma once
// Discs that repel each other, and the walls if there are any, by U = sum overlap^2 / 2, brought to rest by
// FIRE.
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/neighbors.hpp"
#include "common/vec.hpp"

namespace softgrain {

/// Discs in a box [0, width] x [0, height] that can be scaled, between walls or periodic. Lengths in any unit
/// near the mean radius.
class OverlapEnergy {
  public:
    OverlapEnergy(std::vector<double> radius, std::vector<Vec2> center, const Box& box);

    /// Scales the box and all centres about the origin.
    void scale(double factor);
    /// Scales the box about its middle, past discs that stay where they are; with walls only.
    void move_walls(double factor);
    /// Pulls every disc down by `gravity` times its radius squared; 0 at first.
    void set_gravity(double gravity) { gravity_ = gravity; }

    struct State {
        double energy = 0.0;        ///< sum of overlap^2 / 2, without gravity
        double virial = 0.0;        ///< -dU/d(ln box size)
        double mean_overlap = 0.0;  ///< over the contacts
        double largest_overlap = 0.0;
        double largest_force = 0.0;  ///< net, on one disc
        int contacts = 0;            ///< with positive overlap, walls included
    };

    /// Moves the discs downhill until no net force is above `balance` times the mean overlap (they carry each
    /// other), or no overlap is above `clear` (they are free), or the steps are used up.
    State relax(double balance, double clear, int most_steps);

    /// Contacts with more than this overlap: i < j, or j = -1 - wall. After relax.
    std::vector<Pair> contacts(double overlap) const;

    /// Linear strain by which the box must open until no discs overlap. After relax.
    double opening() const;

    const std::vector<Vec2>& center() const { return center_; }
    const std::vector<double>& radius() const { return radius_; }
    double smallest_radius() const;
    /// Centres may lie outside a periodic box.
    const Box& box() const { return box_; }

  private:
    State compute_forces();
    void update_neighbors();
    /// visit(pair, overlap, distance) for every candidate, overlapping or not.
    Vec2 branch(std::size_t pair) const;
    template <class Visit>
    void each_contact(const Visit& visit) const;

    std::vector<double> radius_, mass_;
    std::vector<Vec2> center_, velocity_, force_;
    Box box_;
    double gravity_ = 0.0;
    NeighborList neighbors_;
};

}  // namespace softgrain
