#include "viz/render/triangulate.hpp"

#include <utility>

namespace softgrain {
namespace {

double turn(const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross(b - a, c - b);
}

bool inside(const Vec2& p, const Vec2& a, const Vec2& b, const Vec2& c) {
    return cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0;
}

double twice_area(std::span<const Vec2> polygon) {
    double sum = 0.0;
    for (std::size_t k = 0; k < polygon.size(); ++k)
        sum += cross(polygon[k] - polygon[0], polygon[(k + 1) % polygon.size()] - polygon[0]);
    return sum;
}

/// A counter-clockwise polygon that loses one corner after the other.
class EarClipper {
  public:
    EarClipper(std::span<const Vec2> polygon, std::vector<int> corners)
        : polygon_(polygon), corners_(std::move(corners)) {}

    std::vector<std::array<int, 3>> clip() {
        std::vector<std::array<int, 3>> triangles;
        while (corners_.size() > 3) {
            const std::size_t k = find_ear();
            triangles.push_back({before(k), corners_[k], after(k)});
            corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(k));
        }
        if (corners_.size() == 3) triangles.push_back({corners_[0], corners_[1], corners_[2]});
        return triangles;
    }

  private:
    int before(std::size_t k) const { return corners_[(k + corners_.size() - 1) % corners_.size()]; }
    int after(std::size_t k) const { return corners_[(k + 1) % corners_.size()]; }
    const Vec2& at(int corner) const { return polygon_[static_cast<std::size_t>(corner)]; }

    bool is_ear(std::size_t k) const {
        const Vec2 &a = at(before(k)), &b = at(corners_[k]), &c = at(after(k));
        if (turn(a, b, c) <= 0.0) return false;
        for (const int other : corners_) {
            const Vec2& p = at(other);
            if (p == a || p == b || p == c) continue;
            if (inside(p, a, b, c)) return false;
        }
        return true;
    }
    /// The ear that follows the last one; if there is none (rounding, crossing edges) any corner.
    std::size_t find_ear() {
        for (std::size_t tried = 0; tried < corners_.size(); ++tried) {
            const std::size_t k = (next_ + tried) % corners_.size();
            if (is_ear(k)) {
                next_ = k + 1;
                return k;
            }
        }
        return next_ % corners_.size();
    }

    std::span<const Vec2> polygon_;
    std::vector<int> corners_;
    std::size_t next_ = 0;
};

/// Turns one way all along, and once round.
bool is_convex(std::span<const Vec2> polygon) {
    const std::size_t n = polygon.size();
    int left = 0, right = 0, turns_in_x = 0;
    for (std::size_t k = 0; k < n; ++k) {
        const Vec2 &a = polygon[k], &b = polygon[(k + 1) % n], &c = polygon[(k + 2) % n];
        const double side = turn(a, b, c);
        left += side > 0.0 ? 1 : 0;
        right += side < 0.0 ? 1 : 0;
        turns_in_x += (b.x() >= a.x()) != (c.x() >= b.x()) ? 1 : 0;
    }
    return (left == 0 || right == 0) && turns_in_x <= 2;
}

}  // namespace

std::vector<std::array<int, 3>> triangulate(std::span<const Vec2> polygon) {
    const auto n = static_cast<int>(polygon.size());
    if (n < 3) return {};
    if (is_convex(polygon)) {
        std::vector<std::array<int, 3>> fan;
        const bool clockwise = twice_area(polygon) < 0.0;
        for (int k = 2; k < n; ++k)
            fan.push_back(clockwise ? std::array{0, k, k - 1} : std::array{0, k - 1, k});
        return fan;
    }
    const bool reversed = twice_area(polygon) < 0.0;
    std::vector<int> corners;
    for (int k = 0; k < n; ++k) corners.push_back(reversed ? n - 1 - k : k);
    return EarClipper(polygon, std::move(corners)).clip();
}

}  // namespace softgrain
