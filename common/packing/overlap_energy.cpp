#include "common/packing/overlap_energy.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/stop.hpp"

namespace softgrain {
namespace {

constexpr double skin = 0.3;  // of the mean radius: a rebuild every few hundred steps

// FIRE 2.0, Guenole et al. 2020, with the time step in units where the contact stiffness is 1.
constexpr double first_step = 0.1;
constexpr double shortest_step = 0.02;
constexpr double longest_step = 0.5;  // largest frequency is near sqrt(8)
constexpr double first_mixing = 0.1;
constexpr int delay = 5;

}  // namespace

OverlapEnergy::OverlapEnergy(std::vector<double> radius, std::vector<Vec2> center, const Box& box)
    : radius_(std::move(radius)), center_(std::move(center)), box_(box) {
    velocity_.assign(center_.size(), Vec2::Zero());
    force_.assign(center_.size(), Vec2::Zero());
    const double mean =
        std::accumulate(radius_.begin(), radius_.end(), 0.0) / static_cast<double>(radius_.size());
    // A large disc has as many more contacts as its rim is longer; its mass keeps the frequencies alike.
    for (const double r : radius_) mass_.push_back(std::max(1.0, r / mean));
}

void OverlapEnergy::scale(double factor) {
    box_.position[1] *= factor;
    box_.position[3] *= factor;
    for (Vec2& c : center_) c *= factor;
}

void OverlapEnergy::move_walls(double factor) {
    const Vec2 before{box_.width(), box_.height()};
    box_.position[1] *= factor;
    box_.position[3] *= factor;
    const Vec2 inward = 0.5 * (Vec2{box_.width(), box_.height()} - before);
    for (Vec2& c : center_) c += inward;
}

void OverlapEnergy::update_neighbors() {
    if (!neighbors_.stale(center_, radius_, box_)) return;
    const double mean =
        std::accumulate(radius_.begin(), radius_.end(), 0.0) / static_cast<double>(radius_.size());
    neighbors_.build(center_, radius_, skin * mean, box_);
}

/// From i to j of a pair of the list.
Vec2 OverlapEnergy::branch(std::size_t pair) const {
    const Pair& p = neighbors_.pairs()[pair];
    const Vec2 direct = center_[static_cast<std::size_t>(p.j)] - center_[static_cast<std::size_t>(p.i)];
    return box_.periodic ? direct + box_.image(neighbors_.images()[pair]) : direct;
}

OverlapEnergy::State OverlapEnergy::compute_forces() {
    State result;
    double sum = 0.0;
    const auto add = [&](double overlap, double distance) {
        sum += overlap;
        result.energy += 0.5 * overlap * overlap;
        result.virial += overlap * distance;
        result.largest_overlap = std::max(result.largest_overlap, overlap);
        ++result.contacts;
    };
    for (std::size_t i = 0; i < center_.size(); ++i) {
        const Vec2& c = center_[i];
        const double r = radius_[i];
        Vec2 force{0.0, -gravity_ * r * r};
        const auto against_wall = [&](double distance, int axis, double sign) {
            const double overlap = r - distance;
            if (overlap <= 0.0) return;
            force[axis] += sign * overlap;
            add(overlap, distance);
        };
        if (!box_.periodic) {
            against_wall(c.x(), 0, 1.0);
            against_wall(box_.width() - c.x(), 0, -1.0);
            against_wall(c.y(), 1, 1.0);
            against_wall(box_.height() - c.y(), 1, -1.0);
        }
        force_[i] = force;
    }
    for (std::size_t k = 0; k < neighbors_.pairs().size(); ++k) {
        const auto i = static_cast<std::size_t>(neighbors_.pairs()[k].i);
        const auto j = static_cast<std::size_t>(neighbors_.pairs()[k].j);
        const Vec2 to_j = branch(k);
        const double reach = radius_[i] + radius_[j];
        const double squared = to_j.squaredNorm();
        if (squared >= reach * reach) continue;
        const double distance = std::sqrt(squared);
        const double overlap = reach - distance;
        // Two centres on one point part along x.
        const Vec2 normal = distance > 0.0 ? Vec2(to_j / distance) : Vec2(1.0, 0.0);
        force_[i] -= overlap * normal;
        force_[j] += overlap * normal;
        add(overlap, distance);
    }
    if (result.contacts > 0) result.mean_overlap = sum / result.contacts;
    double largest = 0.0;
    for (const Vec2& f : force_) largest = std::max(largest, f.squaredNorm());
    result.largest_force = std::sqrt(largest);
    return result;
}

OverlapEnergy::State OverlapEnergy::relax(double balance, double clear, int most_steps) {
    std::fill(velocity_.begin(), velocity_.end(), Vec2::Zero());
    double step = first_step;
    double mixing = first_mixing;
    int downhill = 0;
    update_neighbors();
    State result = compute_forces();
    for (int k = 0; k < most_steps; ++k) {
        heed_stop();
        if (result.largest_overlap <= clear || result.largest_force <= balance * result.mean_overlap) break;
        double power = 0.0;
        for (std::size_t i = 0; i < center_.size(); ++i) power += velocity_[i].dot(force_[i]);
        if (power > 0.0) {
            if (++downhill > delay) {
                step = std::min(1.1 * step, longest_step);
                mixing *= 0.99;
            }
        } else {
            // Half a step back, then start again.
            for (std::size_t i = 0; i < center_.size(); ++i) center_[i] -= 0.5 * step * velocity_[i];
            std::fill(velocity_.begin(), velocity_.end(), Vec2::Zero());
            if (downhill > 0) step = std::max(0.5 * step, shortest_step);
            mixing = first_mixing;
            downhill = 0;
        }
        double speed = 0.0, pull = 0.0;
        for (std::size_t i = 0; i < center_.size(); ++i) {
            velocity_[i] += step / mass_[i] * force_[i];
            speed += mass_[i] * velocity_[i].squaredNorm();
            pull += force_[i].squaredNorm() / mass_[i];
        }
        const double turn = mixing * std::sqrt(speed / pull);
        for (std::size_t i = 0; i < center_.size(); ++i)
            velocity_[i] = (1.0 - mixing) * velocity_[i] + turn / mass_[i] * force_[i];
        for (std::size_t i = 0; i < center_.size(); ++i) center_[i] += step * velocity_[i];
        update_neighbors();
        result = compute_forces();
    }
    return result;
}

template <class Visit>
void OverlapEnergy::each_contact(const Visit& visit) const {
    for (std::size_t k = 0; k < neighbors_.pairs().size(); ++k) {
        const Pair& pair = neighbors_.pairs()[k];
        const double distance = branch(k).norm();
        visit(
            pair,
            radius_[static_cast<std::size_t>(pair.i)] + radius_[static_cast<std::size_t>(pair.j)] - distance,
            distance);
    }
    if (box_.periodic) return;
    for (std::size_t i = 0; i < center_.size(); ++i)
        for (int wall = 0; wall < 4; ++wall) {
            const double distance = box_.distance(wall, center_[i]);
            visit(Pair{static_cast<int>(i), -1 - wall}, radius_[i] - distance, distance);
        }
}

std::vector<Pair> OverlapEnergy::contacts(double least_overlap) const {
    std::vector<Pair> found;
    each_contact([&](const Pair& pair, double overlap, double) {
        if (overlap > least_overlap) found.push_back(pair);
    });
    return found;
}

double OverlapEnergy::opening() const {
    double largest = 0.0;
    each_contact([&](const Pair&, double overlap, double distance) {
        largest = std::max(largest, overlap / distance);
    });
    return largest;
}

double OverlapEnergy::smallest_radius() const {
    return *std::min_element(radius_.begin(), radius_.end());
}

}  // namespace softgrain
