#include "common/packing/disc_union.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace softgrain {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

struct Interval {
    double from, to;
};

/// What disc j covers of the circle of disc i: nothing, all of it (`to - from` = 2 pi), or from an angle in
/// [0, 2 pi) on.
std::optional<Interval> covered(std::span<const Disc> discs, std::size_t i, std::size_t j) {
    const double own = discs[i].radius, other = discs[j].radius;
    const Vec2 to_other = discs[j].center - discs[i].center;
    const double distance = to_other.norm();
    if (distance >= own + other) return std::nullopt;
    if (distance <= std::abs(other - own)) {
        const bool inside = own < other || (own == other && j < i);  // of two equal ones the first counts
        return inside ? std::optional(Interval{0.0, turn}) : std::nullopt;
    }
    const double half = std::acos(
        std::clamp((distance * distance + own * own - other * other) / (2.0 * distance * own), -1.0, 1.0));
    double from = std::atan2(to_other.y(), to_other.x()) - half;
    from -= turn * std::floor(from / turn);
    return Interval{from, from + 2.0 * half};
}

Vec2 point_at(std::span<const Disc> discs, std::size_t disc, double angle) {
    return discs[disc].center + discs[disc].radius * Vec2{std::cos(angle), std::sin(angle)};
}

// Antiderivatives of powers of the cosine; those of the sine are their values a quarter turn earlier.
double cos2(double t) {
    return 0.5 * t + 0.25 * std::sin(2.0 * t);
}
double cos3(double t) {
    const double s = std::sin(t);
    return s - s * s * s / 3.0;
}
double cos4(double t) {
    return 0.375 * t + 0.25 * std::sin(2.0 * t) + 0.03125 * std::sin(4.0 * t);
}

/// Integrals of x^n dy / n, n = 1 to 3, along an arc of radius r whose centre has the abscissa c.
struct AxisIntegrals {
    double area, first, second;
};
AxisIntegrals along(double c, double r, double from, double to) {
    const double k1 = std::sin(to) - std::sin(from), k2 = cos2(to) - cos2(from), k3 = cos3(to) - cos3(from),
                 k4 = cos4(to) - cos4(from);
    return {r * (c * k1 + r * k2), 0.5 * r * (c * c * k1 + 2.0 * c * r * k2 + r * r * k3),
            r / 3.0 * (c * c * c * k1 + 3.0 * c * c * r * k2 + 3.0 * c * r * r * k3 + r * r * r * k4)};
}

}  // namespace

std::vector<Arc> boundary_arcs(std::span<const Disc> discs) {
    std::vector<Arc> arcs;
    for (std::size_t i = 0; i < discs.size(); ++i) {
        std::vector<Interval> hidden;
        for (std::size_t j = 0; j < discs.size(); ++j)
            if (j != i)
                if (const auto interval = covered(discs, i, j)) hidden.push_back(*interval);
        if (hidden.empty()) {
            arcs.push_back({i, 0.0, turn});
            continue;
        }
        std::sort(hidden.begin(), hidden.end(),
                  [](const Interval& a, const Interval& b) { return a.from < b.from; });
        // Once around from the first beginning; what goes beyond that covers the start too.
        const double first = hidden.front().from;
        double reached = first;
        for (const Interval& interval : hidden) reached = std::max(reached, interval.to - turn);
        for (const Interval& interval : hidden) {
            if (interval.from > reached) arcs.push_back({i, reached, interval.from});
            reached = std::max(reached, interval.to);
        }
        if (reached < first + turn) arcs.push_back({i, reached, first + turn});
    }
    return arcs;
}

std::vector<std::vector<Arc>> boundary_curves(std::span<const Disc> discs) {
    const std::vector<Arc> arcs = boundary_arcs(discs);
    std::vector<std::size_t> next(arcs.size());
    std::vector<bool> taken(arcs.size(), false);
    for (std::size_t a = 0; a < arcs.size(); ++a) {  // goes on with the arc that begins nearest to its end
        const Vec2 end = point_at(discs, arcs[a].disc, arcs[a].to);
        std::size_t nearest = arcs.size();
        double least = 0.0;
        for (std::size_t b = 0; b < arcs.size(); ++b) {
            if (taken[b]) continue;
            const double distance = (point_at(discs, arcs[b].disc, arcs[b].from) - end).squaredNorm();
            if (nearest == arcs.size() || distance < least) {
                nearest = b;
                least = distance;
            }
        }
        next[a] = nearest;
        taken[nearest] = true;
    }
    std::vector<std::vector<Arc>> curves;
    std::vector<bool> seen(arcs.size(), false);
    for (std::size_t a = 0; a < arcs.size(); ++a) {
        if (seen[a]) continue;
        curves.emplace_back();
        for (std::size_t b = a; !seen[b]; b = next[b]) {
            seen[b] = true;
            curves.back().push_back(arcs[b]);
        }
    }
    return curves;
}

UnionMoments union_moments(std::span<const Disc> discs) {
    UnionMoments sum;
    double second = 0.0;
    // About the first disc, so that a clump far from the origin loses no digits.
    const Vec2 origin = discs.empty() ? Vec2(Vec2::Zero()) : discs.front().center;
    for (const Arc& arc : boundary_arcs(discs)) {
        const Vec2 c = discs[arc.disc].center - origin;
        const double r = discs[arc.disc].radius, quarter = 0.25 * turn;
        const AxisIntegrals x = along(c.x(), r, arc.from, arc.to);
        const AxisIntegrals y = along(c.y(), r, arc.from - quarter, arc.to - quarter);
        sum.area += 0.5 * (x.area + y.area);
        sum.centroid += Vec2{x.first, y.first};
        second += x.second + y.second;
    }
    if (sum.area > 0.0) sum.centroid /= sum.area;
    sum.polar_moment = second - sum.area * sum.centroid.squaredNorm();
    sum.centroid += origin;
    return sum;
}

}  // namespace softgrain
