#include "bpm/outline.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "common/at.hpp"
#include "common/gather.hpp"

namespace softgrain::bpm {
namespace {

constexpr std::size_t worth_threads = 5000;  // discs
constexpr std::size_t blocks = 32;
constexpr double full_turn = 2.0 * std::numbers::pi;
constexpr double polygon_step = std::numbers::pi / 9.0;  // largest angle between two corners

struct Cover {
    double begin, end;  // angles, begin in [0, 2 pi)
    int by;
};

Vec2 direction(double angle) {
    return {std::cos(angle), std::sin(angle)};
}

/// Area swept from the origin by an arc.
double arc_area(const Vec2& center, double radius, double begin, double end) {
    return 0.5 * radius *
           (radius * (end - begin) + center.x() * (std::sin(end) - std::sin(begin)) -
            center.y() * (std::cos(end) - std::cos(begin)));
}

/// Part of the circle (x, a) inside the circle (y, b). Returns false if none; a whole turn if all of it.
bool cover_of(const Vec2& x, double a, const Vec2& y, double b, int by, Cover& cover) {
    const Vec2 line = y - x;
    const double distance2 = line.squaredNorm();
    if (distance2 >= (a + b) * (a + b)) return false;
    const double distance = std::sqrt(distance2);
    if (distance <= std::abs(a - b)) {
        cover = {0.0, full_turn, by};
        return a < b;
    }
    const double half = std::acos(std::clamp((a * a + distance2 - b * b) / (2.0 * a * distance), -1.0, 1.0));
    double begin = std::atan2(line.y(), line.x()) - half;
    if (begin < 0.0) begin += full_turn;
    cover = {begin, begin + 2.0 * half, by};
    return true;
}

/// Appends the gaps between the covers (sorted by begin).
void append_exposed(int disc, std::vector<Cover>& covers, std::vector<ExposedArc>& arcs) {
    if (covers.empty()) {
        arcs.push_back({disc, 0.0, full_turn, -1, -1, false});
        return;
    }
    std::sort(covers.begin(), covers.end(), [](const Cover& a, const Cover& b) { return a.begin < b.begin; });
    // What the covers that pass 2 pi hide at the beginning of the turn.
    const Cover* reach = &covers.front();
    for (const Cover& c : covers)
        if (c.end > reach->end) reach = &c;
    double hidden = reach->end - full_turn;
    int before = reach->by;
    const std::size_t first = arcs.size();
    for (const Cover& c : covers) {
        if (c.begin > hidden) {
            // The gap before the first cover may begin in the last turn.
            arcs.push_back({disc, hidden, c.begin, before, c.by, false});
        }
        if (c.end > hidden) {
            hidden = c.end;
            before = c.by;
        }
    }
    const std::size_t count = arcs.size() - first;
    for (std::size_t k = 0; k < count; ++k) {
        const ExposedArc& next = arcs[first + (k + 1) % count];
        arcs[first + k].neck = arcs[first + k].after == next.before;
    }
}

}  // namespace

Outline::Outline(std::span<const Vec2> x, std::span<const double> radius, double rho,
                 std::span<const Pair> pairs, const Outline* apart)
    : x_(x), radius_(radius), rho_(rho) {
    PairsOfGrain near;
    near.build(pairs, x.size());
    // Blocks of discs by threads, joined in their order.
    const std::size_t n = x.size();
    arc_start_.assign(n + 1, 0);
    std::array<std::vector<ExposedArc>, blocks> arcs;
#pragma omp parallel for schedule(dynamic) if (n > worth_threads)
    for (std::size_t b = 0; b < blocks; ++b) {
        std::vector<Cover> covers;
        for (std::size_t d = b * n / blocks; d < (b + 1) * n / blocks; ++d) {
            if (apart != nullptr && apart->arc_start_[d] == apart->arc_start_[d + 1]) continue;
            covers.clear();
            bool hidden = false;
            for (const PairsOfGrain::Entry& entry : near.of(d)) {
                const Pair& pair = pairs[at(entry.pair)];
                const int other = entry.second ? pair.i : pair.j;
                Cover cover{};
                if (!cover_of(x[d], radius[d] + rho, x[at(other)], radius[at(other)] + rho, other, cover))
                    continue;
                hidden = hidden || cover.end - cover.begin >= full_turn;
                covers.push_back(cover);
            }
            const std::size_t before = arcs[b].size();
            if (!hidden) append_exposed(static_cast<int>(d), covers, arcs[b]);
            arc_start_[d + 1] = static_cast<int>(arcs[b].size() - before);
        }
    }
    std::partial_sum(arc_start_.begin(), arc_start_.end(), arc_start_.begin());
    for (const std::vector<ExposedArc>& block : arcs) arcs_.insert(arcs_.end(), block.begin(), block.end());
}

Outline::Fillet Outline::fillet_after(const ExposedArc& arc) const {
    const Vec2& center = x_[at(arc.disc)];
    const Vec2 corner = center + (radius_[at(arc.disc)] + rho_) * direction(arc.end);
    const Vec2 to_next = x_[at(arc.after)] - corner;
    const Vec2 to_this = center - corner;
    const double turn = std::atan2(cross(to_this, to_next), to_this.dot(to_next));
    return {corner, arc.end + std::numbers::pi, turn};
}

double Outline::area_of(const ExposedArc& arc, const Vec2& origin) const {
    double area = arc_area(x_[at(arc.disc)] - origin, radius_[at(arc.disc)], arc.begin, arc.end);
    if (arc.after < 0) return area;
    const Fillet fillet = fillet_after(arc);
    area += arc_area(fillet.corner - origin, rho_, fillet.begin, fillet.begin + fillet.turn);
    if (arc.neck) {
        // A neck narrower than 2 rho closes at its waist: what the hollow takes beyond the line of centres
        // belongs to the other side.
        const Vec2 line = x_[at(arc.after)] - x_[at(arc.disc)];
        const double height = std::abs(cross(line, fillet.corner - x_[at(arc.disc)])) / line.norm();
        if (height < rho_)
            area +=
                rho_ * rho_ * std::acos(height / rho_) - height * std::sqrt(rho_ * rho_ - height * height);
    }
    return area;
}

double Outline::area(int first_disc, int last_disc) const {
    double area = 0.0;
    if (first_disc == last_disc) return area;
    const Vec2 origin = x_[at(first_disc)];
    for (int k = arc_start_[at(first_disc)]; k < arc_start_[at(last_disc)]; ++k)
        area += area_of(arcs_[at(k)], origin);
    return area;
}

int Outline::arc_after(std::size_t arc) const {
    const ExposedArc& now = arcs_[arc];
    if (now.after < 0) return -1;
    for (int k = arc_start_[at(now.after)]; k < arc_start_[at(now.after) + 1]; ++k)
        if (arcs_[at(k)].before == now.disc) return k;
    return -1;
}

void Outline::append_points(const ExposedArc& arc, std::vector<Vec2>& points) const {
    const auto append = [&](const Vec2& center, double radius, double begin, double turn) {
        const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn) / polygon_step)));
        for (int s = 0; s < steps; ++s)
            points.push_back(center + radius * direction(begin + turn * s / steps));
    };
    append(x_[at(arc.disc)], radius_[at(arc.disc)], arc.begin, arc.end - arc.begin);
    if (arc.after < 0) return;
    const Fillet fillet = fillet_after(arc);
    append(fillet.corner, rho_, fillet.begin, fillet.turn);
}

void Outline::append_polygon(int first_disc, int last_disc, std::vector<Vec2>& points) const {
    const int first_arc = arc_start_[at(first_disc)];
    const int last_arc = arc_start_[at(last_disc)];
    std::vector<char> used(at(last_arc - first_arc), 0);
    std::vector<Vec2> best, loop;
    double best_area = 0.0;
    for (int start = first_arc; start < last_arc; ++start) {
        if (used[at(start - first_arc)]) continue;
        loop.clear();
        for (int k = start; k >= first_arc && k < last_arc && !used[at(k - first_arc)];
             k = arc_after(at(k))) {
            used[at(k - first_arc)] = 1;
            append_points(arcs_[at(k)], loop);
        }
        const double area = polygon_area(loop);
        if (area > best_area) {
            best_area = area;
            best.swap(loop);
        }
    }
    points.insert(points.end(), best.begin(), best.end());
}

double polygon_area(std::span<const Vec2> points) {
    double area = 0.0;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vec2& next = points[k + 1 < points.size() ? k + 1 : 0];
        area += 0.5 * cross(points[k] - points[0], next - points[0]);
    }
    return area;
}

}  // namespace softgrain::bpm
