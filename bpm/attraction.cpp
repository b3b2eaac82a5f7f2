#include "bpm/attraction.hpp"

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"
#include "common/neighbors.hpp"

namespace softgrain::bpm {
namespace {

constexpr int vector_length = 8;
constexpr double far_away = 1e150;
constexpr std::size_t discs_worth_threads = 1000;

std::size_t at(int k) {
    return static_cast<std::size_t>(k);
}

}  // namespace

double AttractionLaw::potential(double distance, double a0) const {
    if (distance >= 2.0 * a0) return 0.0;
    const double at_cut_off = maximum_force * a0 / 6.0 / 64.0;
    if (distance >= a0) {
        const double q = a0 * a0 / (distance * distance);
        return at_cut_off - maximum_force * a0 / 6.0 * q * q * q;
    }
    const double at_touch = at_cut_off - maximum_force * a0 / 6.0;
    return at_touch - maximum_force / (2.0 * a0) * (a0 * a0 - distance * distance);
}

Attraction::Attraction(AttractionLaw law, std::vector<int> grain_start, std::span<const double> radius,
                       double skin)
    : law_(law),
      grain_start_(std::move(grain_start)),
      skin_(skin),
      radius_(radius.begin(), radius.end()),
      x_(radius.size() + 1, far_away),
      y_(radius.size() + 1, far_away),
      lists_(grain_start_.size() - 1) {
    radius_.push_back(1.0);
}

void Attraction::forces(std::span<const Vec2> x, double time, std::span<Vec2> force) {
    const std::size_t grains = lists_.size();
    const bool first = built_at_.empty();
    if (first) built_at_.assign(x.begin(), x.end());
    int lost = -1;
#pragma omp parallel for schedule(static) if (x.size() > discs_worth_threads) reduction(max : lost)
    for (std::size_t g = 0; g < grains; ++g) {
        for (std::size_t d = at(grain_start_[g]); d < at(grain_start_[g + 1]); ++d) {
            x_[d] = x[d].x();
            y_[d] = x[d].y();
        }
        if (first || stale(g, x)) {
            std::copy(x.begin() + grain_start_[g], x.begin() + grain_start_[g + 1],
                      built_at_.begin() + grain_start_[g]);
            rebuild(g);
            if (has_lost_disc(g)) lost = std::max(lost, static_cast<int>(g));
        }
        force_in_grain(g, force);
    }
    if (lost >= 0)
        throw DivergedError(lost, "disc position", time,
                            "a disc has left its grain; load more slowly or use a smaller bpm.step");
}

double Attraction::energy(std::span<const Vec2> x) const {
    double sum = 0.0;
    for (std::size_t g = 0; g < lists_.size(); ++g) {
        const GrainList& list = lists_[g];
        for (int d = grain_start_[g]; d < grain_start_[g + 1]; ++d) {
            const std::size_t row = at(d - grain_start_[g]);
            for (int k = list.start[row]; k < list.start[row + 1]; ++k) {
                const int other = list.neighbor[at(k)];
                if (other <= d || at(other) == x.size()) continue;
                sum += law_.potential((x[at(other)] - x[at(d)]).norm(), radius_[at(d)] + radius_[at(other)]);
            }
        }
    }
    return sum;
}

bool Attraction::stale(std::size_t grain, std::span<const Vec2> x) const {
    const std::size_t first = at(grain_start_[grain]);
    const std::size_t last = at(grain_start_[grain + 1]);
    // The motion of the grain as a whole brings no disc nearer to another.
    Vec2 drift = Vec2::Zero();
    for (std::size_t d = first; d < last; ++d) drift += x[d] - built_at_[d];
    drift /= static_cast<double>(last - first);
    double moved = 0.0;
    for (std::size_t d = first; d < last; ++d)
        moved = std::max(moved, (x[d] - built_at_[d] - drift).squaredNorm());
    return !(2.0 * std::sqrt(moved) < skin_);
}

void Attraction::rebuild(std::size_t grain) {
    const int first = grain_start_[grain];
    const auto count = at(grain_start_[grain + 1] - first);
    std::vector<double> reach(count);
    for (std::size_t k = 0; k < count; ++k) reach[k] = 2.0 * radius_[at(first) + k];
    NeighborList near;
    near.build(std::span<const Vec2>(built_at_).subspan(at(first), count), reach, skin_);

    std::vector<int> degree(count, 0);
    for (const Pair& p : near.pairs()) {
        ++degree[at(p.i)];
        ++degree[at(p.j)];
    }
    GrainList& list = lists_[grain];
    list.start.assign(count + 1, 0);
    for (std::size_t k = 0; k < count; ++k)
        list.start[k + 1] = list.start[k] + (degree[k] + vector_length - 1) / vector_length * vector_length;
    list.neighbor.assign(at(list.start.back()), static_cast<int>(built_at_.size()));
    std::vector<int> fill(list.start.begin(), list.start.end() - 1);
    for (const Pair& p : near.pairs()) {
        list.neighbor[at(fill[at(p.i)]++)] = first + p.j;
        list.neighbor[at(fill[at(p.j)]++)] = first + p.i;
    }
}

bool Attraction::has_lost_disc(std::size_t grain) const {
    const GrainList& list = lists_[grain];
    if (list.start.size() <= 2) return false;  // a grain of one disc
    for (std::size_t k = 0; k + 1 < list.start.size(); ++k)
        if (list.start[k] == list.start[k + 1]) return true;
    return false;
}

void Attraction::force_in_grain(std::size_t grain, std::span<Vec2> force) const {
    const GrainList& list = lists_[grain];
    const double* const x = x_.data();
    const double* const y = y_.data();
    const double* const radius = radius_.data();
    const int* const neighbor = list.neighbor.data();
    for (int d = grain_start_[grain]; d < grain_start_[grain + 1]; ++d) {
        const std::size_t row = at(d - grain_start_[grain]);
        const double xd = x[d], yd = y[d], rd = radius[d];
        double fx = 0.0, fy = 0.0;
#pragma omp simd reduction(+ : fx, fy)
        for (int k = list.start[row]; k < list.start[row + 1]; ++k) {
            const int other = neighbor[k];
            const double dx = x[other] - xd;
            const double dy = y[other] - yd;
            const double a0 = rd + radius[other];
            const double q = std::min(1.0, a0 * a0 / (dx * dx + dy * dy));
            const double q2 = q * q;
            const double f = q > 0.25 ? q2 * q2 / a0 : 0.0;
            fx += f * dx;
            fy += f * dy;
        }
        force[at(d)] = law_.maximum_force * Vec2{fx, fy};
    }
}

void Attraction::save(Checkpoint& to, const std::string& prefix) const {
    to.put(prefix + "built_at", std::span<const Vec2>(built_at_));
}

void Attraction::load(const Checkpoint& from, const std::string& prefix) {
    from.get(prefix + "built_at", built_at_);
    if (built_at_.empty()) return;
    if (built_at_.size() + 1 != radius_.size())
        throw InputError("checkpoint: the attraction lists are for another number of discs");
    for (std::size_t g = 0; g < lists_.size(); ++g) rebuild(g);
}

}  // namespace softgrain::bpm
