#include "common/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/neighbors.hpp"

namespace softgrain {
namespace {

/// Undeformed grains touch at the sum of their radii; so near they must, whatever their deformation.
constexpr double must_touch = 0.6;

std::array<std::optional<double>, watch_limits.size()> limits_of(const Watch& watch) {
    return {watch.energy_residual, watch.momentum, watch.penetration, watch.unconverged, watch.lost_contacts};
}

std::vector<double> inner_radii(const Packing& packing) {
    std::vector<double> radii;
    for (std::size_t g = 0; g < packing.size(); ++g)
        radii.push_back(packing.clumps.empty() ? packing.half_axes(g).minCoeff() : 0.0);
    return radii;
}

double ratio(double part, double whole) {
    return whole > 0.0 ? part / whole : 0.0;
}

}  // namespace

double WatchState::all_broken() const {
    double sum = 0.0;
    for (const double samples : broken) sum += samples;
    return sum;
}

void WatchState::save(Checkpoint& to) const {
    to.put("watch", std::vector<double>{momentum.x(), momentum.y(), impulse.x(), impulse.y(), impulse_sum,
                                        most_work, unconverged, step, time});
    to.put("watch_broken", std::span<const double>(broken));
    to.put("watch_first", std::span<const double>(first));
    to.put("watch_worst", std::span<const double>(worst));
}

void WatchState::load(const Checkpoint& from) {
    std::vector<double> values;
    from.get("watch", values);
    momentum = {values.at(0), values.at(1)};
    impulse = {values.at(2), values.at(3)};
    impulse_sum = values.at(4);
    most_work = values.at(5);
    unconverged = values.at(6);
    step = values.at(7);
    time = values.at(8);
    const auto read = [&](std::string_view name, std::array<double, watch_limits.size()>& into) {
        from.get(name, values);
        for (std::size_t k = 0; k < into.size(); ++k) into[k] = values.at(k);
    };
    read("watch_broken", broken);
    read("watch_first", first);
    read("watch_worst", worst);
}

Watchdog::Watchdog(const Watch& watch, const Packing& packing, double mean_diameter)
    : watch_(watch), mean_diameter_(mean_diameter) {
    if (!packing.driven.empty()) watch_.momentum.reset();  // their impulses are not known step by step
    if (watch_.lost_contacts) inner_radius_ = inner_radii(packing);
}

void Watchdog::add_step(WatchState& state, const std::array<Vec2, 4>& before,
                        const std::array<Vec2, 4>& after, double dt) const {
    if (!watch_.momentum) return;
    for (std::size_t w = 0; w < 4; ++w) {
        const Vec2 impulse = -0.5 * dt * (before[w] + after[w]);
        state.impulse += impulse;
        state.impulse_sum += impulse.norm();
    }
}

std::vector<BrokenLimit> Watchdog::check(WatchState& state, const GrainView& view, double initial_energy,
                                         double step) const {
    const double steps = step - state.step;
    std::array<double, watch_limits.size()> value{};
    value[0] = energy_error(state, view, initial_energy);
    value[1] = watch_.momentum ? momentum_error(state, view) : 0.0;
    value[2] = view.contact_report.penetration / mean_diameter_;
    value[3] = ratio(view.contact_report.unconverged_steps - state.unconverged, steps);
    value[4] = watch_.lost_contacts ? lost_contacts(view) : 0.0;
    state.step = step;
    state.time = view.time;
    if (std::isfinite(view.contact_report.unconverged_steps))
        state.unconverged = view.contact_report.unconverged_steps;

    std::vector<BrokenLimit> all;
    const auto limit = limits_of(watch_);
    for (std::size_t k = 0; k < limit.size(); ++k) {
        if (!limit[k] || !(value[k] > *limit[k])) continue;  // what a method does not give is not a number
        if (state.broken[k] == 0.0) state.first[k] = view.time;
        state.broken[k] += 1.0;
        state.worst[k] = std::max(state.worst[k], value[k]);
        all.push_back(
            {k, fmt::format("{:.3g}, the limit watch.{} is {:g}", value[k], watch_limits[k], *limit[k])});
    }
    return all;
}

double Watchdog::energy_error(WatchState& state, const GrainView& view, double initial_energy) const {
    const EnergyLedger& e = view.energy;
    state.most_work = std::max(state.most_work, std::abs(e.external_work));
    const double residual = initial_energy + e.external_work - e.kinetic - e.elastic - e.dissipated();
    return ratio(std::abs(residual), std::abs(initial_energy) + state.most_work);
}

double Watchdog::momentum_error(WatchState& state, const GrainView& view) const {
    Vec2 momentum = Vec2::Zero();
    double mass = 0.0;
    for (std::size_t g = 0; g < view.free_size(); ++g) {
        momentum += view.mass[g] * view.velocity[g];
        mass += view.mass[g];
    }
    const Vec2 weights = mass * (view.time - state.time) * view.gravity;
    const double error = ratio((momentum - state.momentum - state.impulse - weights).norm(),
                               state.impulse_sum + weights.norm());
    state.momentum = momentum;
    state.impulse.setZero();
    state.impulse_sum = 0.0;
    return error;
}

double Watchdog::lost_contacts(const GrainView& view) const {
    std::vector<double> reach;
    for (const double radius : inner_radius_) reach.push_back(must_touch * radius);
    const double smallest = *std::min_element(reach.begin(), reach.end());
    if (smallest == 0.0) return 0.0;
    NeighborList near;
    near.build(view.centroid, reach, 1e-6 * smallest, view.box);
    double lost = 0.0;
    for (const Pair& pair : near.pairs()) {
        if (static_cast<std::size_t>(pair.i) >= view.free_size()) continue;  // driven grains feel no force
        const auto at = std::lower_bound(
            view.contacts.begin(), view.contacts.end(), pair,
            [](const GrainContact& c, const Pair& p) { return c.i != p.i ? c.i < p.i : c.j < p.j; });
        if (at == view.contacts.end() || at->i != pair.i || at->j != pair.j) lost += 1.0;
    }
    return lost;
}

std::vector<std::string> warnings_of(const WatchState& state, const Watch& watch) {
    std::vector<std::string> lines;
    const auto limit = limits_of(watch);
    for (std::size_t k = 0; k < limit.size(); ++k)
        if (state.broken[k] > 0.0)
            lines.push_back(fmt::format(
                "watch.{} = {:g} was broken at {:.0f} samples, first at t = {:.6g} s, at worst {:.3g}",
                watch_limits[k], limit[k].value_or(0.0), state.broken[k], state.first[k], state.worst[k]));
    return lines;
}

}  // namespace softgrain
