#include "common/packing/geometric.hpp"

#include <algorithm>
#include <cmath>

#include "common/neighbors.hpp"

namespace softgrain {
namespace {

// Discs that touch may overlap by rounding; the box is opened by it in the end.
constexpr double touching = 1e-11;

/// Discs from the middle outwards, and the closed chain of those that are outside.
class Front {
  public:
    Front(const std::vector<double>& radii, double aspect_ratio)
        : radius_(radii),
          aspect_ratio_(aspect_ratio),
          center_(radii.size(), Vec2::Zero()),
          next_(radii.size()),
          previous_(radii.size()) {}

    std::vector<Vec2> place() {
        begin();
        std::size_t a = 0;
        for (std::size_t k = 3; k < radius_.size(); ++k) a = add(k, a);
        return std::move(center_);
    }

  private:
    void link(std::size_t a, std::size_t b) {
        next_[a] = b;
        previous_[b] = a;
    }

    void begin() {
        if (radius_.size() < 2) return;
        center_[0] = {-radius_[1], 0.0};
        center_[1] = {radius_[0], 0.0};
        if (radius_.size() < 3) return;
        center_[2] = against(1, 0, radius_[2]);
        link(0, 2);
        link(2, 1);
        link(1, 0);
    }

    /// Where a disc touches a and b, to the left of the way from a to b.
    Vec2 against(std::size_t a, std::size_t b, double radius) const {
        const Vec2 way = center_[b] - center_[a];
        const double square = way.squaredNorm();
        const double from_a = radius_[a] + radius, from_b = radius_[b] + radius;
        const double along = 0.5 + (from_a * from_a - from_b * from_b) / (2.0 * square);
        const double across = std::sqrt(std::max(0.0, from_a * from_a / square - along * along));
        return center_[a] + along * way + across * perpendicular(way);
    }

    bool overlap(std::size_t a, std::size_t b) const {
        const double reach = (1.0 - touching) * (radius_[a] + radius_[b]);
        return (center_[a] - center_[b]).squaredNorm() < reach * reach;
    }

    /// Puts disc c outside of the link after a, or of what takes its place: the discs between those that it
    /// touches leave the front. Returns the disc before the innermost link.
    std::size_t add(std::size_t c, std::size_t a) {
        std::size_t b = next_[a];
        for (;;) {
            center_[c] = against(b, a, radius_[c]);
            const auto [hit, ahead] = nearest_hit(c, a, b);
            if (hit == c) break;
            (ahead ? b : a) = hit;
            link(a, b);
        }
        link(a, c);
        link(c, b);
        std::size_t innermost = a;
        double least = outwardness(a);
        for (std::size_t k = c; k != a; k = next_[k])
            if (const double here = outwardness(k); here < least) {
                least = here;
                innermost = k;
            }
        return innermost;
    }

    /// The disc of the front that c overlaps, the nearest along the front, and whether it comes after b (else
    /// before a); c if there is none.
    struct Hit {
        std::size_t disc;
        bool ahead;
    };
    Hit nearest_hit(std::size_t c, std::size_t a, std::size_t b) const {
        std::size_t after = next_[b], before = previous_[a];
        double way_after = radius_[b], way_before = radius_[a];
        do {
            if (way_after <= way_before) {
                if (overlap(after, c)) return {after, true};
                way_after += radius_[after];
                after = next_[after];
            } else {
                if (overlap(before, c)) return {before, false};
                way_before += radius_[before];
                before = previous_[before];
            }
        } while (after != next_[before]);
        return {c, true};
    }

    /// How far out the link after disc k lies, by rectangles around the middle.
    double outwardness(std::size_t k) const {
        const std::size_t j = next_[k];
        const Vec2 touch = (center_[k] * radius_[j] + center_[j] * radius_[k]) / (radius_[k] + radius_[j]);
        return std::max(std::abs(touch.x()), std::abs(touch.y()) / aspect_ratio_);
    }

    const std::vector<double>& radius_;
    double aspect_ratio_;
    std::vector<Vec2> center_;
    std::vector<std::size_t> next_, previous_;
};

/// Linear strain by which all distances must grow until no discs overlap.
double opening(const std::vector<Vec2>& center, const std::vector<double>& radii) {
    NeighborList near;
    near.build(center, radii, *std::min_element(radii.begin(), radii.end()));
    double largest = 0.0;
    for (const Pair& pair : near.pairs()) {
        const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
        largest = std::max(largest, (radii[i] + radii[j]) / (center[j] - center[i]).norm() - 1.0);
    }
    return largest;
}

}  // namespace

Packing geometric(const std::vector<double>& radii, const PackingRequest& request) {
    std::vector<Vec2> center = Front(radii, request.aspect_ratio).place();
    const double open = 1.0 + opening(center, radii);
    Vec2 low = Vec2::Constant(INFINITY), high = -low;
    for (std::size_t k = 0; k < radii.size(); ++k) {
        center[k] *= open;
        low = low.cwiseMin(center[k] - Vec2::Constant(radii[k]));
        high = high.cwiseMax(center[k] + Vec2::Constant(radii[k]));
    }
    const double width = std::max(high.x() - low.x(), (high.y() - low.y()) / request.aspect_ratio);
    const Vec2 size{width, request.aspect_ratio * width};
    const Vec2 shift = 0.5 * (size - low - high);
    for (Vec2& c : center) c += shift;
    return {.box = Box{{0.0, size.x(), 0.0, size.y()}},
            .center = std::move(center),
            .radius = radii,
            .frame = {}};
}

}  // namespace softgrain
