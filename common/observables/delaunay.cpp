#include "common/observables/delaunay.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/at.hpp"
#include "common/space_order.hpp"

namespace softgrain {
namespace {

__extension__ using Wide = __int128;

constexpr int infinite = -1;  // the point beyond the hull

int after(int k) {
    return (k + 1) % 3;
}

class Triangulator {
  public:
    explicit Triangulator(const std::vector<GridPoint>& points)
        : point_(points), face_from_(points.size() + 1) {}

    std::vector<Triangle> triangulate(const std::vector<int>& order) {
        const std::vector<int> rest = begin(order);
        for (const int p : rest) insert(p);
        std::vector<Triangle> triangles;
        for (const Face& face : faces_) {
            const auto least = std::min_element(face.corner.begin(), face.corner.end());
            if (*least == infinite) continue;
            Triangle triangle;
            std::rotate_copy(face.corner.begin(), least, face.corner.end(), triangle.begin());
            triangles.push_back(triangle);
        }
        std::sort(triangles.begin(), triangles.end());
        return triangles;
    }

  private:
    /// Beyond the edge opposite of corner k lies the face neighbor[k].
    struct Face {
        Triangle corner;
        std::array<int, 3> neighbor;
        int seen_for = infinite;  ///< the point for which it was last found to be in the cavity
    };
    /// Of the cavity's rim, counter-clockwise, with the face outside.
    struct Edge {
        int from, to, outside;
    };

    /// Positive if c lies to the left of the way from a to b.
    std::int64_t turn(int a, int b, int c) const {
        const GridPoint &p = point_[at(a)], &q = point_[at(b)], &r = point_[at(c)];
        return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
    }

    bool same(int a, int b) const {
        return point_[at(a)].x == point_[at(b)].x && point_[at(a)].y == point_[at(b)].y;
    }

    /// d strictly inside the circle through a, b, c.
    bool in_circle(const Triangle& corner, int d) const {
        std::array<std::int64_t, 3> x, y, square;
        for (std::size_t k = 0; k < 3; ++k) {
            x[k] = point_[at(corner[k])].x - point_[at(d)].x;
            y[k] = point_[at(corner[k])].y - point_[at(d)].y;
            square[k] = x[k] * x[k] + y[k] * y[k];
        }
        Wide sum = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t i = (k + 1) % 3, j = (k + 2) % 3;
            sum += Wide{square[k]} * Wide{x[i] * y[j] - x[j] * y[i]};
        }
        return sum > 0;
    }

    /// The circle of a face at infinity is the half plane beyond its edge, with the edge.
    bool in_conflict(const Face& face, int p) const {
        for (int k = 0; k < 3; ++k) {
            if (face.corner[at(k)] != infinite) continue;
            const int a = face.corner[at(after(k))], b = face.corner[at(after(after(k)))];
            const std::int64_t side = turn(a, b, p);
            return side > 0 || (side == 0 && between(a, b, p));
        }
        return in_circle(face.corner, p);
    }

    /// p on the line through a and b, strictly between them.
    bool between(int a, int b, int p) const {
        const GridPoint &from = point_[at(a)], &to = point_[at(b)], &x = point_[at(p)];
        return (x.x - from.x) * (x.x - to.x) + (x.y - from.y) * (x.y - to.y) < 0;
    }

    /// Starts with three points that are not on a line; returns the others. None if there are no three.
    std::vector<int> begin(const std::vector<int>& order) {
        std::vector<int> rest = order;
        Triangle first{};
        std::size_t found = 0;
        const auto take = [&](const auto& fits) {
            const auto it = std::find_if(rest.begin(), rest.end(), fits);
            if (it == rest.end()) return;
            first[found++] = *it;
            rest.erase(it);
        };
        take([](int) { return true; });
        if (found == 1) take([&](int p) { return !same(first[0], p); });
        if (found == 2) take([&](int p) { return turn(first[0], first[1], p) != 0; });
        if (found < 3) return {};
        if (turn(first[0], first[1], first[2]) < 0) std::swap(first[1], first[2]);
        faces_.push_back({first, {2, 3, 1}});
        for (int k = 0; k < 3; ++k) {  // beyond the edge from corner k to the next
            const int before = 1 + (k + 2) % 3, next = 1 + after(k);
            faces_.push_back({{first[at(after(k))], first[at(k)], infinite}, {before, next, 0}});
        }
        return rest;
    }

    /// A face whose circle holds p, or -1 if p is one of the corners there.
    int find(int p) const {
        int face = last_;
        for (;;) {
            const Face& f = faces_[at(face)];
            int towards = -1;
            for (int k = 0; k < 3 && towards < 0; ++k) {
                const int a = f.corner[at(after(k))], b = f.corner[at(after(after(k)))];
                if (turn(a, b, p) < 0) towards = f.neighbor[at(k)];
            }
            if (towards < 0)
                return std::any_of(f.corner.begin(), f.corner.end(), [&](int c) { return same(c, p); })
                           ? -1
                           : face;
            const Triangle& corner = faces_[at(towards)].corner;
            if (std::find(corner.begin(), corner.end(), infinite) != corner.end()) return towards;
            face = towards;
        }
    }

    void insert(int p) {
        const int first = find(p);
        if (first < 0) return;
        cavity_.assign(1, first);
        faces_[at(first)].seen_for = p;
        rim_.clear();
        for (std::size_t c = 0; c < cavity_.size(); ++c)
            for (int k = 0; k < 3; ++k) {
                const Face& face = faces_[at(cavity_[c])];
                const int beyond = face.neighbor[at(k)];
                if (faces_[at(beyond)].seen_for == p) continue;
                if (in_conflict(faces_[at(beyond)], p)) {
                    faces_[at(beyond)].seen_for = p;
                    cavity_.push_back(beyond);
                } else {
                    rim_.push_back({face.corner[at(after(k))], face.corner[at(after(after(k)))], beyond});
                }
            }
        fill(p);
    }

    /// Joins p to the rim, in the places of the cavity's faces and two more.
    void fill(int p) {
        while (cavity_.size() < rim_.size()) {
            cavity_.push_back(static_cast<int>(faces_.size()));
            faces_.push_back({});
        }
        for (std::size_t e = 0; e < rim_.size(); ++e) {
            const Edge& edge = rim_[e];
            const int here = cavity_[e];
            faces_[at(here)] = {{edge.from, edge.to, p}, {-1, -1, edge.outside}};
            Face& outside = faces_[at(edge.outside)];
            for (int k = 0; k < 3; ++k)
                if (outside.corner[at(after(k))] == edge.to &&
                    outside.corner[at(after(after(k)))] == edge.from)
                    outside.neighbor[at(k)] = here;
            face_from_[at(edge.from + 1)] = here;
            if (edge.from != infinite && edge.to != infinite) last_ = here;
        }
        for (std::size_t e = 0; e < rim_.size(); ++e) {
            const int next = face_from_[at(rim_[e].to + 1)];  // shares the edge from rim_[e].to to p
            faces_[at(cavity_[e])].neighbor[0] = next;
            faces_[at(next)].neighbor[1] = cavity_[e];
        }
    }

    const std::vector<GridPoint>& point_;
    std::vector<Face> faces_;
    int last_ = 0;  ///< a face that is not at infinity
    std::vector<int> cavity_;
    std::vector<Edge> rim_;
    std::vector<int> face_from_;  ///< [points + 1] the new face whose rim edge begins there, infinity first
};

}  // namespace

std::vector<Triangle> delaunay(const std::vector<GridPoint>& points) {
    std::vector<Vec2> place;
    for (const GridPoint& p : points) place.emplace_back(static_cast<double>(p.x), static_cast<double>(p.y));
    if (points.size() < 3) return {};
    const double cell = static_cast<double>(grid_extent) / std::sqrt(static_cast<double>(points.size()));
    return Triangulator(points).triangulate(space_order(place, cell));
}

std::vector<Triangle> delaunay(std::span<const Vec2> points) {
    if (points.size() < 3) return {};
    Vec2 low = points.front(), high = low;
    for (const Vec2& p : points) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double extent = (high - low).maxCoeff();
    if (!(extent > 0.0)) return {};
    const double scale = static_cast<double>(grid_extent) / extent;
    std::vector<GridPoint> grid;
    for (const Vec2& p : points)
        grid.push_back({std::llround(scale * (p.x() - low.x())), std::llround(scale * (p.y() - low.y()))});
    return delaunay(grid);
}

}  // namespace softgrain
