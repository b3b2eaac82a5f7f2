#include "bpm/bonds.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/at.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

/// Tension of a bond [N] along the unit vector to the other disc.
struct Stretch {
    double spring, speed;  ///< k (r - r0) [N], dr/dt [m/s]
    Vec2 direction;
};

Stretch stretch_of(const BondLaw& law, double rest, const Vec2& line, const Vec2& speed) {
    const double distance = line.norm();
    const Vec2 direction = distance > 0.0 ? Vec2(line / distance) : Vec2::UnitX();
    return {law.stiffness * (distance - rest), direction.dot(speed), direction};
}

}  // namespace

Bonds::Bonds(const BondLaw& law, std::span<const Vec2> x, std::span<const double> radius,
             std::span<const double> mass, std::span<const int> grain)
    : law_(law), start_(x.size() + 1, 0) {
    NeighborList near;
    near.build(x, radius, law.reach);
    for (const Pair& pair : near.pairs()) {
        const std::size_t i = at(pair.i), j = at(pair.j);
        if (grain[i] != grain[j]) continue;
        const double distance = (x[j] - x[i]).norm();
        if (distance - radius[i] - radius[j] >= law.reach) continue;
        const double reduced = mass[i] * mass[j] / (mass[i] + mass[j]);
        pairs_.push_back(pair);
        rest_.push_back(distance);
        damping_.push_back(2.0 * law.damping * std::sqrt(law.stiffness * reduced));
    }
    made_ = pairs_.size();
    list_ends();
}

void Bonds::list_ends() {
    std::fill(start_.begin(), start_.end(), 0);
    for (const Pair& pair : pairs_) {
        ++start_[at(pair.i) + 1];
        ++start_[at(pair.j) + 1];
    }
    std::partial_sum(start_.begin(), start_.end(), start_.begin());
    ends_.resize(2 * pairs_.size());
    std::vector<int> fill(start_.begin(), start_.end() - 1);
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        ends_[at(fill[at(pairs_[k].i)]++)] = {pairs_[k].j, rest_[k], damping_[k]};
        ends_[at(fill[at(pairs_[k].j)]++)] = {pairs_[k].i, rest_[k], damping_[k]};
    }
}

void Bonds::forces(std::span<const Vec2> x, std::span<const Vec2> v, std::span<Vec2> force,
                   bool threads) const {
#pragma omp parallel for schedule(static) if (threads)
    for (std::size_t d = 0; d < x.size(); ++d) {
        Vec2 sum = Vec2::Zero();
        for (int k = start_[d]; k < start_[d + 1]; ++k) {
            const End& end = ends_[at(k)];
            const Stretch s = stretch_of(law_, end.rest, x[at(end.other)] - x[d], v[at(end.other)] - v[d]);
            sum += (s.spring + end.damping * s.speed) * s.direction;
        }
        force[d] = sum;
    }
}

double Bonds::energy(std::span<const Vec2> x) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const double stretch = (x[at(pairs_[k].j)] - x[at(pairs_[k].i)]).norm() - rest_[k];
        sum += 0.5 * law_.stiffness * stretch * stretch;
    }
    return sum;
}

double Bonds::damping_power(std::span<const Vec2> x, std::span<const Vec2> before,
                            std::span<const Vec2> after) const {
    double sum = 0.0;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const std::size_t i = at(pairs_[k].i), j = at(pairs_[k].j);
        const Vec2 line = x[j] - x[i];
        const double at_start = stretch_of(law_, rest_[k], line, before[j] - before[i]).speed;
        const double at_end = stretch_of(law_, rest_[k], line, after[j] - after[i]).speed;
        sum += damping_[k] * at_start * 0.5 * (at_start + at_end);
    }
    return sum;
}

double Bonds::break_bonds(std::span<const Vec2> x) {
    if (!std::isfinite(law_.strength)) return -1.0;
    double released = 0.0;
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
        const double stretch = (x[at(pairs_[k].j)] - x[at(pairs_[k].i)]).norm() - rest_[k];
        if (law_.stiffness * stretch > law_.strength) {
            released += 0.5 * law_.stiffness * stretch * stretch;
            continue;
        }
        pairs_[kept] = pairs_[k];
        rest_[kept] = rest_[k];
        damping_[kept] = damping_[k];
        ++kept;
    }
    if (kept == pairs_.size()) return -1.0;
    pairs_.resize(kept);
    rest_.resize(kept);
    damping_.resize(kept);
    list_ends();
    return released;
}

std::vector<int> Bonds::fragments() const {
    const std::size_t n = start_.size() - 1;
    std::vector<int> label(n, -1), pending;
    int count = 0;
    for (std::size_t first = 0; first < n; ++first) {
        if (label[first] >= 0) continue;
        label[first] = count;
        pending.assign(1, static_cast<int>(first));
        while (!pending.empty()) {
            const std::size_t d = at(pending.back());
            pending.pop_back();
            for (int k = start_[d]; k < start_[d + 1]; ++k) {
                int& other = label[at(ends_[at(k)].other)];
                if (other >= 0) continue;
                other = count;
                pending.push_back(ends_[at(k)].other);
            }
        }
        ++count;
    }
    return label;
}

double Bonds::stable_time_step(std::span<const double> mass) const {
    // Gershgorin: no frequency above sqrt(2 k bonds / m); the leapfrog is stable up to 2 / frequency.
    double stiffest = 0.0;
    for (std::size_t d = 0; d < mass.size(); ++d)
        stiffest = std::max(stiffest, 2.0 * law_.stiffness * (start_[d + 1] - start_[d]) / mass[d]);
    return stiffest > 0.0 ? 2.0 / std::sqrt(stiffest) : std::numeric_limits<double>::infinity();
}

void Bonds::save(Checkpoint& to, const std::string& prefix) const {
    std::vector<int> ends;
    for (const Pair& pair : pairs_) ends.insert(ends.end(), {pair.i, pair.j});
    to.put(prefix + "pairs", std::span<const int>(ends));
}

void Bonds::load(const Checkpoint& from, const std::string& prefix) {
    std::vector<int> ends;
    from.get(prefix + "pairs", ends);
    std::size_t kept = 0;
    for (std::size_t k = 0; k < pairs_.size() && 2 * kept < ends.size(); ++k) {
        if (pairs_[k].i != ends[2 * kept] || pairs_[k].j != ends[2 * kept + 1]) continue;
        pairs_[kept] = pairs_[k];
        rest_[kept] = rest_[k];
        damping_[kept] = damping_[k];
        ++kept;
    }
    if (2 * kept != ends.size())
        throw InputError("checkpoint: its bonds are not those of this scenario; use the same scenario");
    pairs_.resize(kept);
    rest_.resize(kept);
    damping_.resize(kept);
    list_ends();
}

}  // namespace softgrain::bpm
