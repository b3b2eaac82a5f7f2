// The aggregates take the places of the packing's discs.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bpm/solver.hpp"
#include "common/at.hpp"
#include "common/errors.hpp"
#include "common/stop.hpp"

namespace softgrain::bpm {
namespace {

// The grains start so far apart that no rough outline overlaps another, and are drawn together; what overlaps
// is pushed apart at rest. Then the grains come to rest under their own forces.
constexpr double approach = 0.03;  // of two grains that touch, in a step [mean disc diameters]
constexpr int most_placing_steps = 300;
constexpr int most_resting_steps = 1000;
constexpr double placed_overlap = 1e-3;  // [mean disc diameters]
constexpr double resting_speed = 2e-3;   // root mean square, in sqrt(F0 d / m)
constexpr double resting_damping = 0.5;  // rate, in sqrt(F0 / (m d))
constexpr double misfit_overlap = 0.02;  // a packing that keeps more overlap is too dense
constexpr double misfit_dilation = 4.0;  // factor of distances, beyond that of any rough outline

Vec2 centre_of(const Box& box) {
    return {0.5 * (box.position[0] + box.position[1]), 0.5 * (box.position[2] + box.position[3])};
}

Box dilated(const Box& box, double factor) {
    Box larger = box;
    const Vec2 centre = centre_of(box);
    for (int w = 0; w < 4; ++w) {
        const double c = centre[wall_axis(w)];
        larger.position[at(w)] = c + factor * (box.position[at(w)] - c);
    }
    return larger;
}

InputError misfit(const std::string& what) {
    return InputError("bpm: the aggregates do not fit into the packing: " + what +
                      "; start from a looser packing (smaller packing.packing_fraction)");
}

/// Factor of all distances at which circles of radius `reach` would not overlap, nor the walls; infinite if
/// centres coincide or lie on a wall or behind it.
double clearing_dilation(const std::vector<Vec2>& centre, const std::vector<double>& reach, const Box& box) {
    double factor = 1.0;
    NeighborList near;
    near.build(centre, reach, 1e-9 * reach.front());
    for (const Pair& pair : near.pairs())
        factor = std::max(factor, (reach[at(pair.i)] + reach[at(pair.j)]) /
                                      (centre[at(pair.j)] - centre[at(pair.i)]).norm());
    for (std::size_t g = 0; g < centre.size(); ++g)
        for (int w = 0; w < 4; ++w)
            factor = std::max(factor, reach[g] / std::max(0.0, box.distance(w, centre[g])));
    return factor;
}

}  // namespace

void BpmSolver::place(const Box& box, double h) {
    try {
        draw_together(box, h);
        for (int k = 0; penetration_ > placed_overlap && k < most_placing_steps; ++k) step_at_rest(box, h);
    } catch (const DivergedError& error) {
        throw misfit(error.what());
    }
    if (penetration_ > misfit_overlap)
        throw misfit(fmt::format("discs still overlap by {:.3g} of their diameter", penetration_));
    come_to_rest(box, h);
    time_ = 0.0;
    energy_ = {};
}

void BpmSolver::draw_together(const Box& box, double h) {
    view_grains();
    std::vector<double> reach(grains(), 0.0);
    for (std::size_t d = 0; d < x_.size(); ++d) {
        double& own = reach[at(grain_[d])];
        own = std::max(own, (x_[d] - centroid_[at(grain_[d])]).norm() + radius_[d]);
    }
    double dilation = clearing_dilation(centroid_, reach, box);
    if (!(dilation <= misfit_dilation))
        throw misfit(fmt::format(
            "two grains, or a grain and a wall, are so near that all distances would have to be {:.3g} "
            "times as large to part them",
            dilation));
    const double largest = *std::max_element(reach.begin(), reach.end());
    const auto steps =
        static_cast<int>(std::ceil(std::log(dilation) * 2.0 * largest / (approach * diameter_)));
    const Vec2 centre = centre_of(box);
    const auto move_grains = [&](double factor) {
        view_grains();
        for (std::size_t d = 0; d < x_.size(); ++d)
            x_[d] += (factor - 1.0) * (centroid_[at(grain_[d])] - centre);
    };
    move_grains(dilation);
    for (int k = 0; k < steps; ++k) {
        const double factor = std::pow(dilation, -1.0 / (steps - k));
        dilation *= factor;
        move_grains(factor);
        step_at_rest(dilated(box, dilation), h);
    }
    step_at_rest(box, h);
}

void BpmSolver::step_at_rest(const Box& box, double h) {
    heed_stop();
    step({box, {}}, h);
    stop_discs();
}

void BpmSolver::stop_discs() {
    std::fill(v_.begin(), v_.end(), Vec2::Zero());
    std::fill(rim_speed_.begin(), rim_speed_.end(), 0.0);
}

void BpmSolver::come_to_rest(const Box& box, double h) {
    const double mean_mass =
        std::accumulate(mass_.begin(), mass_.end(), 0.0) / static_cast<double>(x_.size());
    const double unit_speed = std::sqrt(maximum_force_ * diameter_ / mean_mass);
    const double keep = 1.0 - resting_damping * h * unit_speed / diameter_;
    const auto root_mean_square_speed = [&] {
        double sum = 0.0;
        for (const Vec2& v : v_) sum += v.squaredNorm();
        return std::sqrt(sum / static_cast<double>(v_.size()));
    };
    for (int k = 0; k < most_resting_steps; ++k) {
        heed_stop();
        step({box, {}}, h);
        if (root_mean_square_speed() < resting_speed * unit_speed) break;
        for (Vec2& v : v_) v *= keep;
        for (double& w : rim_speed_) w *= keep;
    }
    stop_discs();
}

}  // namespace softgrain::bpm
