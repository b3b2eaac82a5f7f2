#pragma once
// Contacts as far as a step of Newton's method sees them: gaps that change linearly.
#include <span>
#include <vector>

#include <Eigen/Core>

#include "mpm/contact/contacts.hpp"
#include "mpm/contact/friction.hpp"

namespace softgrain::mpm {

/// A dense symmetric matrix on some nodes.
struct ContactStiffness {
    std::vector<int> node;   ///< of all nodes, ascending
    Eigen::MatrixXd matrix;  ///< [2 nodes x 2 nodes], lower triangle
};

/// What a point does.
struct Touch {
    bool presses = false;
    signed char slides = 0;  ///< forward (1), back (-1), or held by its spring (0)

    friend bool operator==(const Touch&, const Touch&) = default;
};

/// Adds stiffness * by by^T on some nodes.
struct ContactSpring {
    std::vector<int> node;  ///< of all nodes
    std::vector<Vec2> by;
    double stiffness;  ///< [N/m] negative if it is taken away
};

/// Gaps g + grad g . d of all points that touch or are near. Energy: k/2 (g + grad g . d)^2 of each active
/// point, and half of d . (force x second derivative of g) d of those that touch at d = 0. Friction: springs
/// along the tangent that slide at a known force, whether the point presses or not.
class ContactModel {
  public:
    explicit ContactModel(const Grains& grains) : grains_(grains) {}

    /// Of the last evaluate(). sliders [points], or empty without friction.
    void build(const Contacts& contacts, std::span<const Slider> sliders = {});
    /// [points] for a step d [all nodes]; without d as they are now.
    void find_active(std::span<const Vec2> d, std::vector<Touch>& active) const;
    /// Of the groups, in their order.
    void find_stiffness(std::span<const Touch> active, std::vector<ContactStiffness>& out) const;
    /// What find_stiffness() finds more for `to` than for `from`.
    void find_changes(std::span<const Touch> from, std::span<const Touch> to,
                      std::vector<ContactSpring>& out) const;
    /// Adds -k g grad g of the points that press, and friction: what they push their nodes with at d = 0.
    void add_force(std::span<const Touch> active, std::span<Vec2> force) const;
    /// Energy of a step d.
    double energy(std::span<const Vec2> d) const;

    std::size_t points() const { return point_.size(); }
    /// Friction as the normal forces of points that have moved so allow it. Returns the largest change [N].
    double bound_friction(std::span<const Vec2> moved);
    /// Largest friction of the points [N].
    std::vector<double> most() const;
    /// Motion of a point over the place that it touches, for a step d.
    Vec2 difference(std::size_t point, std::span<const Vec2> d) const;
    Touch touch(std::size_t point, const Vec2& moved) const;
    /// On i, if the point touched so [N].
    Vec2 force(std::size_t point, const Vec2& moved, Touch as) const;

  private:
    struct Point {
        int first, count;  ///< in entries
        double gap, stiffness;
        Vec2 normal, tangent;
        double bend;  ///< force / (speed^2 - gap curvature); 0 of walls and of points that do not touch
        double speed, curvature;
        Slider slider;
    };
    struct Entry {
        int local;          ///< in the nodes of the group
        double difference;  ///< d(p - c) by the node
        double slope;       ///< d(dc/dt) by the node
    };

    const Grains& grains_;
    std::vector<Point> point_;
    std::vector<std::vector<Entry>> entry_;  ///< by groups
    std::vector<std::vector<int>> node_;     ///< by groups
    std::vector<std::array<int, 2>> range_;  ///< points of each group
    std::vector<int> group_of_;
};

}  // namespace softgrain::mpm
