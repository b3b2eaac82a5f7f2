#pragma once
// Contacts of rigid discs by Box2D 2.4.1, in place of ContactDynamics.
#include <memory>
#include <span>

#include "bpm/solved_contacts.hpp"
#include "common/box.hpp"
#include "common/contact_dynamics/contact_dynamics.hpp"
#include "common/contact_dynamics/discs.hpp"

namespace softgrain::bpm {

struct Box2dSettings {
    int velocity_iterations = 8;
    int position_iterations = 3;
    double friction = 0.0;  ///< between discs of different groups
    double units = 100.0;   ///< of Box2D per mean disc diameter; its slop is 0.005, its largest move 2
    double diameter = 1.0;  ///< mean disc diameter [m]
    double mass = 1.0;      ///< unit of mass, near that of a disc [kg]
    double time = 1.0;      ///< unit of time, sqrt(m d / F0) [s]
};

/// Inelastic contact (restitution 0) between discs, and with four frictionless walls. Box2D counts in single
/// precision, knows a contact only once discs overlap, and removes part of an overlap by moving discs without
/// changing their velocities. Serial; the same bits in every run.
class Box2dContacts {
  public:
    /// Throws InputError if the box is too wide for single precision.
    Box2dContacts(const Box2dSettings& settings, const Discs& discs, const Box& box);
    ~Box2dContacts();
    Box2dContacts(const Box2dContacts&) = delete;
    Box2dContacts& operator=(const Box2dContacts&) = delete;

    /// Changes discs.v and discs.rim_speed from the velocities without contact to those at the end of the
    /// step, and x (which may be discs.x) to the positions there. discs.x must be as the last step left it.
    /// The result has the deepest overlap before the step and the iterations; it always counts as converged.
    ContactResult solve(const Discs& discs, const WallMotion& walls, double h, std::span<Vec2> x);

    /// Box2D cuts off larger displacements in a step, without a word [m].
    double largest_move() const;

    /// The touching pairs of the last step. Columns that only ContactDynamics needs are empty.
    SolvedContacts contacts() const { return {rows_, wall_rows_}; }
    /// Adds pairs, and discs and walls, with a smaller gap [m] after the step, with zero impulses.
    void add_near(const Discs& discs, const Box& box, double gap);

  private:
    struct World;

    void place_walls(const WallMotion& walls);
    double read_contacts(const Discs& discs, const Box& box);
    void add_row(const Discs& discs, int i, int j, double normal, double tangential);

    Box2dSettings settings_;
    Vec2 origin_;    ///< of Box2D's coordinates [m]
    double length_;  ///< unit of length [m]
    double speed_;   ///< unit of velocity [m/s]
    std::unique_ptr<World> world_;
    ContactRows rows_;
    WallRows wall_rows_;
};

}  // namespace softgrain::bpm
