#include "sdem/geometry/clipped_ellipse.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

namespace softgrain::sdem {
namespace {

constexpr double pi = std::numbers::pi;

bool cuts_the_circle(const Cut& cut) {
    return cut.distance < 1.0 && cut.distance > -1.0;
}

/// Length of cut k's line that lies in the unit disc and in all other half planes.
double straight_length(std::span<const Cut> cuts, std::size_t k) {
    const Cut& own = cuts[k];
    const double half = std::sqrt((1.0 - own.distance) * (1.0 + own.distance));
    double low = -half, high = half;
    const Vec2 along = perpendicular(own.direction);
    for (std::size_t l = 0; l < cuts.size(); ++l) {
        if (l == k) continue;
        const double slope = cuts[l].direction.dot(along);
        const double room = cuts[l].distance - own.distance * cuts[l].direction.dot(own.direction);
        if (slope > 0.0) {
            high = std::min(high, room / slope);
        } else if (slope < 0.0) {
            low = std::max(low, room / slope);
        } else if (room < 0.0 || (room == 0.0 && l < k)) {
            return 0.0;  // hidden behind a parallel cut, or the same line twice
        }
    }
    return std::max(0.0, high - low);
}

/// Total angle of the unit circle outside all cuts.
double free_arc(std::span<const Cut> cuts) {
    std::vector<std::pair<double, double>> covered;
    for (const Cut& cut : cuts) {
        if (!cuts_the_circle(cut)) continue;
        const double middle = std::atan2(cut.direction.y(), cut.direction.x());
        const double half = std::acos(cut.distance);
        const double low = middle - half, high = middle + half;
        if (low < -pi) {
            covered.emplace_back(low + 2.0 * pi, pi);
            covered.emplace_back(-pi, high);
        } else if (high > pi) {
            covered.emplace_back(low, pi);
            covered.emplace_back(-pi, high - 2.0 * pi);
        } else {
            covered.emplace_back(low, high);
        }
    }
    std::sort(covered.begin(), covered.end());
    double free = 0.0, reached = -pi;
    for (const auto& [low, high] : covered) {
        free += std::max(0.0, low - reached);
        reached = std::max(reached, high);
    }
    return free + std::max(0.0, pi - reached);
}

/// Sutherland-Hodgman: keeps the part of a convex polygon inside one half plane.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Cut& cut) {
    std::vector<Vec2> kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
        const Vec2& from = polygon[k];
        const Vec2& to = polygon[(k + 1) % polygon.size()];
        const double a = cut.direction.dot(from) - cut.distance;
        const double b = cut.direction.dot(to) - cut.distance;
        if (a <= 0.0) kept.push_back(from);
        if ((a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0)) kept.push_back(from + (a / (a - b)) * (to - from));
    }
    return kept;
}

}  // namespace

Cut cut_of(const Ellipse& e, const Vec2& normal, const Vec2& point) {
    const Vec2 image = e.axes.transpose() * normal;
    const double support = image.norm();
    return {image / support, normal.dot(point - e.center) / support};
}

double clipped_area(const Ellipse& e, std::span<const Cut> cuts) {
    // Green: twice the area is the sum over edges of distance * length, plus the free arc of radius 1.
    double twice = free_arc(cuts);
    for (std::size_t k = 0; k < cuts.size(); ++k)
        if (cuts_the_circle(cuts[k])) twice += cuts[k].distance * straight_length(cuts, k);
    for (const Cut& cut : cuts)
        if (cut.distance <= -1.0) return 0.0;
    return 0.5 * e.det * std::max(0.0, twice);
}

void append_clipped_outline(const Ellipse& e, std::span<const Cut> cuts, int nodes,
                            std::vector<Vec2>& outline) {
    std::vector<double> angle;
    for (int k = 0; k < nodes; ++k) angle.push_back(-pi + 2.0 * pi * k / nodes);
    for (const Cut& cut : cuts) {
        if (!cuts_the_circle(cut)) continue;
        const double middle = std::atan2(cut.direction.y(), cut.direction.x());
        const double half = std::acos(cut.distance);
        angle.push_back(std::remainder(middle - half, 2.0 * pi));
        angle.push_back(std::remainder(middle + half, 2.0 * pi));
    }
    std::sort(angle.begin(), angle.end());
    std::vector<Vec2> polygon;
    for (double a : angle) polygon.emplace_back(std::cos(a), std::sin(a));
    for (const Cut& cut : cuts) polygon = clipped(polygon, cut);
    for (const Vec2& u : polygon) outline.push_back(e.center + e.axes * u);
}

}  // namespace softgrain::sdem
