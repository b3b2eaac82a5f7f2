#pragma once
// Rigid clusters (clumps) of discs. Contacts see only discs; each clump gathers what its discs feel, moves as
// the disc of its mass and moment of inertia would, and takes its discs along.
#include <span>
#include <vector>

#include "common/packing/packing.hpp"
#include "common/scenario.hpp"
#include "rigid_dem/blocks.hpp"
#include "rigid_dem/motion_kernel.hpp"

namespace softgrain::rigid_dem {

/// The discs of all grains as a packing of discs, those of grain 0 first. Of the same class as their grain.
Packing packing_of_discs(const Packing& packing);

/// Position and velocities of a clump.
struct ClumpState {
    double x, y, vx, vy, spin, angle;
};

/// Discs are numbered as in packing_of_discs, and found by their records (GrainRecord).
class Clumps {
  public:
    /// At rest. A grain of a class without clumps is a clump of one disc.
    Clumps(const Scenario& scenario, const Packing& packing);

    std::size_t size() const { return body_.size(); }
    std::size_t discs() const { return owner_.size(); }
    /// The clump that a disc belongs to.
    std::size_t owner(std::size_t disc) const { return owner_[disc]; }
    std::size_t record_of(std::size_t disc) const { return record_of_[disc]; }
    std::span<const double> mass() const { return mass_; }      ///< [n] [kg]
    std::span<const double> radius() const { return radius_; }  ///< [n] of the disc of the same area [m]
    double largest_reach() const { return largest_reach_; }     ///< from a centre [m]
    double moment_of_inertia(std::size_t clump) const { return inertia_[clump]; }  ///< [kg m^2]
    std::span<const double> angles() const { return angle_; }                      ///< [n] [rad]
    /// From the centre of its clump to a disc's [m].
    double arm(std::size_t disc) const { return arm_[disc].norm(); }
    Vec2 arm_now(std::size_t disc) const;
    /// Least mass that a push at the disc moves, 1/m + arm^2/I as its inverse [kg].
    double mass_at(std::size_t disc) const;

    /// Each clump as the disc of its mass and inertia, which motion kernels move; its radius is not that of
    /// the clump.
    std::span<GrainRecord> bodies() { return body_; }
    std::span<const GrainRecord> bodies() const { return body_; }
    /// What they feel, since gather().
    std::span<const ForceSum> forces() const { return force_; }

    /// Where the discs are, after a new list; `order`: disc by place in space.
    void find_discs(std::span<const std::uint32_t> order, std::span<const Block> blocks);

    /// Sums the forces on discs, and its weight, to those on each clump. Returns the sum of force on disc (x)
    /// arm [N m].
    Mat2 gather(std::span<const GrainRecord> record, std::span<const ForceSum> force, const Vec2& gravity,
                bool threads);

    /// Turns the clumps by their spin over dt, and moves the discs after them. Returns the largest squared
    /// speed that a disc's centre may have against the flow; not a number if one is not [m^2/s^2].
    double turn(double dt, const Flow& flow, std::span<GrainRecord> record, bool threads);
    /// Discs where their clumps have them, with their velocities.
    void place_discs(std::span<GrainRecord> record) const;

    /// Outline of a clump [m].
    std::vector<Vec2> outline(std::size_t clump) const;

    ClumpState state(std::size_t clump) const;
    void set_state(std::size_t clump, const ClumpState& state);

  private:
    void set_angle(std::size_t clump, double angle);
    void place_discs_of(std::size_t clump, std::span<GrainRecord> record) const;

    // by clump [n]
    std::vector<double> mass_, inertia_, radius_, reach_, angle_;
    std::vector<Vec2> direction_;      ///< of its own x axis
    std::vector<std::uint8_t> shape_;  ///< into shapes_
    std::vector<GrainRecord> body_;
    std::vector<ForceSum> force_;
    std::vector<std::uint32_t> first_;  ///< [n + 1] of its discs
    double largest_reach_ = 0.0;
    std::vector<ClumpShape> shapes_;

    // by disc
    std::vector<std::uint32_t> owner_, record_of_;
    std::vector<Vec2> arm_;  ///< in the frame of the clump [m]
};

}  // namespace softgrain::rigid_dem
