#include "sdem/geometry/polygon_reference.hpp"

#include <numbers>
#include <optional>

namespace softgrain::sdem {
namespace {

/// The polygon of an ellipse, asked in its reference frame, where it is regular with circumradius 1.
class RegularPolygon {
  public:
    RegularPolygon(const Ellipse& e, int nodes)
        : center_(e.center),
          inverse_(e.inverse),
          step_(2.0 * std::numbers::pi / nodes),
          apothem_(std::cos(0.5 * step_)) {}

    /// Positive outside, zero on the polygon's edges; exact for the polygon, not for the ellipse.
    double level(const Vec2& x) const {
        const Vec2 u = inverse_ * (x - center_);
        const double middle = (std::floor(std::atan2(u.y(), u.x()) / step_) + 0.5) * step_;
        return u.x() * std::cos(middle) + u.y() * std::sin(middle) - apothem_;
    }
    /// Most points are told by the circles around and inside the polygon.
    bool contains(const Vec2& x) const {
        const double r2 = (inverse_ * (x - center_)).squaredNorm();
        if (r2 > 1.0) return false;
        return r2 <= apothem_ * apothem_ || level(x) <= 0.0;
    }

  private:
    Vec2 center_;
    Mat2 inverse_;
    double step_, apothem_;
};

/// Where the edge from outside to inside enters the polygon: false position, exact once both ends look at the
/// same edge of the polygon.
Vec2 crossing(const RegularPolygon& polygon, Vec2 outside, Vec2 inside) {
    double above = polygon.level(outside), below = polygon.level(inside);
    Vec2 x = inside;
    for (int k = 0; k < 60; ++k) {
        x = outside + (above / (above - below)) * (inside - outside);
        const double level = polygon.level(x);
        if (std::abs(level) < 1e-15) break;
        if (level > 0.0) {
            outside = x;
            above = level;
        } else {
            inside = x;
            below = level;
        }
    }
    return x;
}

/// Entry and exit of the outline `nodes` into the polygon of the other grain.
struct Crossings {
    Vec2 entry, exit;
};
std::optional<Crossings> crossings_of(const std::vector<Vec2>& nodes, const RegularPolygon& other) {
    std::optional<Vec2> entry, exit;
    const std::size_t n = nodes.size();
    bool inside_before = other.contains(nodes[n - 1]);
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2& before = nodes[k == 0 ? n - 1 : k - 1];
        const bool is_inside = other.contains(nodes[k]);
        if (is_inside && !inside_before) entry = crossing(other, before, nodes[k]);
        if (!is_inside && inside_before) exit = crossing(other, nodes[k], before);
        inside_before = is_inside;
    }
    if (!entry || !exit) return std::nullopt;
    return Crossings{*entry, *exit};
}

/// Depth and area of the part of a polygon that lies on the side of `direction` of the chord from p to q.
struct Cap {
    double depth = 0.0, area = 0.0;
};
Cap cap_beyond(const std::vector<Vec2>& nodes, const Vec2& p, const Vec2& q, const Vec2& direction) {
    Cap cap;
    // The nodes beyond the chord follow each other; the first one after a node on this side opens the cap.
    const std::size_t n = nodes.size();
    const auto beyond = [&](std::size_t k) { return direction.dot(nodes[k < n ? k : k - n] - p); };
    std::size_t first = 0;
    while (first < n && !(beyond(first) > 0.0 && beyond(first + n - 1) <= 0.0)) ++first;
    if (first == n) return cap;
    // Counter-clockwise outline: with `direction` on the right of the chord's vector, the arc runs along it.
    const bool along = cross(q - p, direction) < 0.0;
    Vec2 last = along ? p : q;
    const Vec2 start = last;
    const Vec2 end = along ? q : p;
    double twice = 0.0;
    for (std::size_t k = first; beyond(k) > 0.0 && k < first + n; ++k) {
        cap.depth = std::max(cap.depth, beyond(k));
        twice += cross(last - start, nodes[k < n ? k : k - n] - start);
        last = nodes[k < n ? k : k - n];
    }
    twice += cross(last - start, end - start);
    cap.area = 0.5 * twice;
    return cap;
}

}  // namespace

namespace {

/// Unit vectors at equal steps of angle, kept from call to call.
const std::vector<Vec2>& directions(int nodes) {
    static thread_local std::vector<Vec2> kept;
    if (kept.size() != static_cast<std::size_t>(nodes)) {
        kept.clear();
        const double step = 2.0 * std::numbers::pi / nodes;
        for (int k = 0; k < nodes; ++k) kept.emplace_back(std::cos(step * k), std::sin(step * k));
    }
    return kept;
}

}  // namespace

std::vector<Vec2> outline_nodes(const Ellipse& e, int nodes) {
    std::vector<Vec2> x;
    x.reserve(static_cast<std::size_t>(nodes));
    for (const Vec2& u : directions(nodes)) x.emplace_back(e.center + e.axes * u);
    return x;
}

Chord polygon_chord(const Ellipse& i, const Ellipse& j, int nodes) {
    const std::vector<Vec2> outline_i = outline_nodes(i, nodes), outline_j = outline_nodes(j, nodes);
    std::optional<Crossings> points = crossings_of(outline_j, RegularPolygon(i, nodes));
    if (!points) {
        points = crossings_of(outline_i, RegularPolygon(j, nodes));
        if (!points) return Chord{};
        std::swap(points->entry, points->exit);
    }
    Chord c;
    const Vec2 p = points->entry, q = points->exit;  // counter-clockwise over j's cap
    c.length = (q - p).norm();
    if (!(c.length > 0.0)) return c;
    c.overlap = Overlap::chord;
    c.normal = perpendicular(q - p) / c.length;
    c.point = 0.5 * (p + q);
    const Cap cap_i = cap_beyond(outline_i, p, q, c.normal);
    const Cap cap_j = cap_beyond(outline_j, p, q, -c.normal);
    c.depth_i = cap_i.depth;
    c.depth_j = cap_j.depth;
    c.cap_i = cap_i.area;
    c.cap_j = cap_j.area;
    return c;
}

}  // namespace softgrain::sdem
