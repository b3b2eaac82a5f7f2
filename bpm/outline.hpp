#pragma once
// The outline of a set of discs: its morphological closing by a disc of radius rho.
#include <span>
#include <vector>

#include "common/neighbors.hpp"
#include "common/vec.hpp"

namespace softgrain::bpm {

/// Counter-clockwise part of a disc's rim that no other disc, both grown by rho, covers.
struct ExposedArc {
    int disc;
    double begin, end;  ///< angles [rad], begin < end
    int before, after;  ///< discs that cover the rim before and after; -1 for a whole circle
    /// The rim behind `after` is exposed as well: disc and `after` form a neck between two outlines.
    bool neck;
};

/// Discs grown by rho, then shrunk by rho: pores that a disc of radius rho cannot enter are filled, the
/// outline passes around the outer discs. Bounded by arcs of the discs and hollow arcs of radius rho between
/// them; the same topology as the alpha complex of the weighted Delaunay triangulation with weights (r +
/// rho)^2.
class Outline {
  public:
    /// x, radius [n] [m]; pairs: sorted, at least all with a gap < 2 rho that are to be joined. `apart`: the
    /// outline by some of these pairs, if it is there already; discs that it hides are not looked at again.
    Outline(std::span<const Vec2> x, std::span<const double> radius, double rho, std::span<const Pair> pairs,
            const Outline* apart = nullptr);

    std::span<const ExposedArc> arcs() const { return arcs_; }

    /// Area inside all loops of the outline, holes not counted [m^2]. Joined discs must be in one range.
    double area() const { return area(0, static_cast<int>(x_.size())); }
    double area(int first_disc, int last_disc) const;

    /// Appends the outer loop of the discs [first, last) as a counter-clockwise polygon with corners on the
    /// exact outline.
    void append_polygon(int first_disc, int last_disc, std::vector<Vec2>& points) const;

  private:
    struct Fillet {
        Vec2 corner;
        double begin, turn;  ///< angle of its start and (negative) angle turned [rad]
    };
    Fillet fillet_after(const ExposedArc& arc) const;
    double area_of(const ExposedArc& arc, const Vec2& origin) const;
    int arc_after(std::size_t arc) const;
    void append_points(const ExposedArc& arc, std::vector<Vec2>& points) const;

    std::span<const Vec2> x_;
    std::span<const double> radius_;
    double rho_;
    std::vector<ExposedArc> arcs_;
    std::vector<int> arc_start_;  ///< [n + 1] first arc of each disc
};

/// Signed area of a polygon, positive if counter-clockwise [m^2].
double polygon_area(std::span<const Vec2> points);

}  // namespace softgrain::bpm
