#include "mpm/contact/friction.hpp"

#include <algorithm>
#include <tuple>

#include "common/errors.hpp"
#include "mpm/contact/spread.hpp"
#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {
namespace {

/// Stiffness along the surface / across.
constexpr double softness = 0.05;

auto key(int i, int point, int j) {
    return std::tuple(i, point, j);
}

}  // namespace

Friction::Friction(const Grains& grains, double between_grains, double at_walls)
    : grains_(grains), between_grains_(between_grains), at_walls_(at_walls) {
    wall_force_.fill(Vec2::Zero());
}

void Friction::begin(const Surfaces& surfaces) {
    if (exists()) from_ = surfaces;
}

double Friction::force_of_spring(const PointContact& c) const {
    const auto at = std::lower_bound(
        springs_.begin(), springs_.end(), key(c.i, c.point, c.j),
        [](const FrictionSpring& s, const auto& wanted) { return key(s.i, s.point, s.j) < wanted; });
    const bool found = at != springs_.end() && key(at->i, at->point, at->j) == key(c.i, c.point, c.j);
    return found ? at->force : 0.0;
}

void Friction::lag(const Contacts& contacts) {
    if (!exists()) return;
    contact_.assign(contacts.points().begin(), contacts.points().end());
    slider_.assign(contact_.size(), {});
    for (std::size_t p = 0; p < contact_.size(); ++p) {
        const PointContact& c = contact_[p];
        const double mu = coefficient(c.j);
        if (mu > 0.0) slider_[p] = {mu * c.force(), softness * c.stiffness, mu, force_of_spring(c), 0.0};
    }
}

void Friction::bound(std::span<const double> most) {
    for (std::size_t p = 0; p < slider_.size(); ++p) slider_[p].most = most[p];
}

/// From the matter of j that is at the contact's place to the point.
Vec2 Friction::apart(const PointContact& c, const Surfaces& surfaces) const {
    const Vec2& x =
        surfaces.points_of(grains_, static_cast<std::size_t>(c.i))[static_cast<std::size_t>(c.point)];
    if (c.j < 0) return x;
    const auto control = surfaces.controls_of(grains_, static_cast<std::size_t>(c.j));
    const SplineSpan s = spline_span(c.place.t);
    Vec2 on_j = Vec2::Zero();
    for (std::size_t k = 0; k < 3; ++k)
        on_j += s.value[k] * control[(static_cast<std::size_t>(c.place.span) + k) % control.size()];
    return x - on_j;
}

double Friction::evaluate(const Surfaces& surfaces, std::span<Vec2> force) {
    wall_force_.fill(Vec2::Zero());
    double energy = 0.0;
    for (std::size_t p = 0; p < slider_.size(); ++p) {
        Slider& s = slider_[p];
        if (s.stiffness == 0.0) continue;
        const PointContact& c = contact_[p];
        const double slip = c.place.tangent.dot(apart(c, surfaces) - apart(c, from_));
        s.trial = s.start + s.stiffness * slip;
        energy += s.energy_at(s.trial) - s.energy_at(s.start);
        const Vec2 pull = s.force() * c.place.tangent;
        spread_on_contact(grains_, c, pull, force);
        if (c.j < 0) wall_force_[static_cast<std::size_t>(-1 - c.j)] += pull;
    }
    return energy;
}

double Friction::stored() const {
    double sum = 0.0;
    for (const FrictionSpring& s : springs_) sum += 0.5 * s.force * s.force / s.stiffness;
    return sum;
}

double Friction::end() {
    if (!exists()) return 0.0;
    double dissipated = stored();
    springs_.clear();
    for (std::size_t p = 0; p < slider_.size(); ++p) {
        const Slider& s = slider_[p];
        if (s.most == 0.0) continue;
        const PointContact& c = contact_[p];
        dissipated += s.energy_at(s.trial) - s.energy_at(s.start);
        springs_.push_back({c.i, c.point, c.j, s.force(), s.stiffness});
    }
    std::sort(springs_.begin(), springs_.end(), [](const FrictionSpring& a, const FrictionSpring& b) {
        return key(a.i, a.point, a.j) < key(b.i, b.point, b.j);
    });
    return dissipated - stored();
}

void Friction::save(Checkpoint& to) const {
    std::vector<int> place;
    std::vector<double> value;
    for (const FrictionSpring& s : springs_) {
        place.insert(place.end(), {s.i, s.point, s.j});
        value.insert(value.end(), {s.force, s.stiffness});
    }
    to.put("mpm.friction.place", std::span<const int>(place));
    to.put("mpm.friction.spring", std::span<const double>(value));
}

void Friction::load(const Checkpoint& from) {
    std::vector<int> place;
    std::vector<double> value;
    from.get("mpm.friction.place", place);
    from.get("mpm.friction.spring", value);
    if (2 * place.size() != 3 * value.size())
        throw InputError("checkpoint: springs of friction without their places; it is broken");
    springs_.clear();
    for (std::size_t k = 0; 2 * k < value.size(); ++k)
        springs_.push_back(
            {place[3 * k], place[3 * k + 1], place[3 * k + 2], value[2 * k], value[2 * k + 1]});
}

}  // namespace softgrain::mpm
