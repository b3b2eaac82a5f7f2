#pragma once
// Contact of surfaces: points of each grain against the curve of the other, and against walls.
#include <span>
#include <vector>

#include "common/box.hpp"
#include "common/neighbors.hpp"
#include "mpm/contact/closest_point.hpp"
#include "mpm/grains.hpp"

namespace softgrain::mpm {

/// Surfaces of all grains for given nodes.
struct Surfaces {
    std::vector<Vec2> control;  ///< [grains * controls]
    std::vector<Vec2> point;    ///< [grains * surface points]

    void update(const Grains& grains, std::span<const Vec2> q);
    std::span<const Vec2> controls_of(const Grains& grains, std::size_t g) const {
        const std::size_t n = grains.disc->control.size();
        return {control.data() + g * n, n};
    }
    std::span<const Vec2> points_of(const Grains& grains, std::size_t g) const {
        const std::size_t n = grains.disc->surface.size();
        return {point.data() + g * n, n};
    }
};

/// A surface point of grain i that overlaps grain j or a wall (j = -1 - wall), or is near to it.
struct PointContact {
    int i, point, j;
    CurvePlace place;  ///< on j; of a wall only gap and normal (into the box)
    double stiffness;  ///< of the spring: penalty times undeformed length [N/m]

    bool touches() const { return place.gap < 0.0; }
    double force() const { return touches() ? -stiffness * place.gap : 0.0; }  ///< on i along the normal [N]
};

/// Points of a pair of grains, or of a grain with a wall.
struct ContactGroup {
    int i, j;          ///< i < j, or j = -1 - wall
    int first, count;  ///< in Contacts::points; those of i first
};

/// All contacts of a state, found anew for each. Overlap g < 0 costs the energy k/2 g^2 for each surface
/// point (PHYSICS: two passes, each with half of the length); k is `penalty` times the modulus over the grid
/// spacing, so that both grains give way by less than the grid can tell.
class Contacts {
  public:
    Contacts(const Grains& grains, double penalty);

    /// Lists pairs of grains that can meet, if the last list may no longer be complete.
    void watch(const Surfaces& surfaces);
    /// Energy [J]; adds its derivative to `force` [all nodes].
    double evaluate(const Surfaces& surfaces, const Box& box, std::span<Vec2> force);

    double energy() const { return energy_; }  ///< [J]
    std::span<const PointContact> points() const { return points_; }
    /// Sorted by (i, j), walls first.
    std::span<const ContactGroup> groups() const { return groups_; }
    /// By grains on walls [N].
    const std::array<Vec2, 4>& wall_force() const { return wall_force_; }

  private:
    void find_near(const Box& box);
    void find_points(const Surfaces& surfaces, std::size_t i, std::size_t j, double length,
                     std::vector<PointContact>& out) const;
    void find_wall_points(const Surfaces& surfaces, const Box& box, std::size_t i, int wall,
                          std::vector<PointContact>& out) const;
    double mean_radius() const;

    const Grains& grains_;
    double penalty_;
    double near_gap_;  ///< of points that are listed without touching [m]
    NeighborList pairs_;
    std::vector<Vec2> center_;
    std::vector<double> reach_;
    std::vector<Vec2> low_, high_;                  ///< corners around each grain
    std::vector<Pair> near_;                        ///< sorted by (i, j), walls first
    std::vector<std::vector<PointContact>> found_;  ///< [near]
    std::vector<PointContact> points_;
    std::vector<ContactGroup> groups_;
    std::array<Vec2, 4> wall_force_;
    double energy_ = 0.0;
};

}  // namespace softgrain::mpm
