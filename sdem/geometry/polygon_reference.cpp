#include "sdem/geometry/polygon_reference.hpp"

#include <numbers>
#include <optional>

namespace softgrain::sdem {
namespace {

/// The polygon of an ellipse, asked in its reference frame, where it is regular with circumradius 1.
class RegularPolygon {
  public:
    RegularPolygon(const Ellipse& e, int nodes)
        : center_(e.center), inverse_(e.inverse), step_(2.0 * std::numbers::pi / nodes) {}

    /// Positive outside, zero on the polygon's edges; exact for the polygon, not for the ellipse.
    double level(const Vec2& x) const {
        const Vec2 u = inverse_ * (x - center_);
        const double middle = (std::floor(std::atan2(u.y(), u.x()) / step_) + 0.5) * step_;
        return u.x() * std::cos(middle) + u.y() * std::sin(middle) - std::cos(0.5 * step_);
    }

  private:
    Vec2 center_;
    Mat2 inverse_;
    double step_;
};

/// Where the edge from a (outside) to b (inside) enters the polygon.
Vec2 crossing(const RegularPolygon& polygon, Vec2 outside, Vec2 inside) {
    for (int k = 0; k < 52; ++k) {
        const Vec2 middle = 0.5 * (outside + inside);
        (polygon.level(middle) > 0.0 ? outside : inside) = middle;
    }
    return 0.5 * (outside + inside);
}

/// Entry and exit of the outline `nodes` into the polygon of the other grain.
struct Crossings {
    Vec2 entry, exit;
};
std::optional<Crossings> crossings_of(const std::vector<Vec2>& nodes, const RegularPolygon& other) {
    std::optional<Vec2> entry, exit;
    const std::size_t n = nodes.size();
    bool inside_before = other.level(nodes[n - 1]) <= 0.0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2& before = nodes[(k + n - 1) % n];
        const bool is_inside = other.level(nodes[k]) <= 0.0;
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
    const auto beyond = [&](std::size_t k) { return direction.dot(nodes[k % n] - p); };
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
        twice += cross(last - start, nodes[k % n] - start);
        last = nodes[k % n];
    }
    twice += cross(last - start, end - start);
    cap.area = 0.5 * twice;
    return cap;
}

}  // namespace

std::vector<Vec2> outline_nodes(const Ellipse& e, int nodes) {
    std::vector<Vec2> x(static_cast<std::size_t>(nodes));
    const double step = 2.0 * std::numbers::pi / nodes;
    for (std::size_t k = 0; k < x.size(); ++k) {
        const double beta = step * static_cast<double>(k);
        x[k] = e.center + e.axes * Vec2{std::cos(beta), std::sin(beta)};
    }
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
