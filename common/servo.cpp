#include "common/servo.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

// The law, for each axis: strain rate = (set point - stress) / (K tau) + offset.
// - A packing of stiffness K answers after T = L sqrt(rho / K), the way of a wave through it. With tau = T
//   the walls give way like dashpots of twice its acoustic impedance: they take energy out of waves, and the
//   stress comes to its set point as exp(-t / tau). K tau goes with sqrt(K): an error in K matters little.
// - The stress is smoothed over tau / 10, too short to matter for the loop: real roots while K is not
//   underrated by more than 2.5 times, damping of 0.5 at 10 times.
// - The set point goes from where the stage begins to the target no faster than K times the largest rate,
//   and settles within 2 tau: both axes then go a straight way.
// - Before the grains touch, K is the stress scale of the grains (at least ten times the target). The rate is
//   then so small that a packing that jams stops the walls with a stress far below the target.
// - The offset (integral over 8 tau) cancels what a driven axis or a shear does. It is let in only beside
//   those, once the stress has come within a tenth of the way (or 1 %): it cannot carry it beyond the target.
// - A periodic cell strains all its grains at once: no wave has to cross it, and T is the way through a few
//   grains.
constexpr double response_times = 1.0;
constexpr double grains_across = 4.0;
constexpr double smoothing = 0.1;
constexpr double settling = 2.0;
constexpr double integral = 8.0;
constexpr double near = 0.1;
constexpr double haste_back = 3.0;
/// Fewest time steps in tau.
constexpr double fewest_steps = 40.0;

/// A look at the stiffness needs a change of stress by the stiffness so far, or as it is, of these shares.
constexpr double noticeable = 0.02, considerable = 0.1;
/// Response times after which a look begins anew: by then the packing may have crept.
constexpr double longest_look = 20.0;
/// Largest change of the stiffness in one look.
constexpr double most_up = 2.0, most_down = 0.5;
/// Below this share of the target a packing is not yet one, and its stiffness says nothing of what comes.
constexpr double carries = 0.1;
/// Stiffness / stress: a packing is not strained elastically by more than a tenth.
constexpr double least_stiffness = 10.0;

double share_of(double dt, double time_constant) {
    return -std::expm1(-dt / time_constant);
}

double length(const Box& box, int axis) {
    return axis == 0 ? box.width() : box.height();
}

}  // namespace

Servo::Servo(const StressTargets& targets, const Box& initial, double density, double diameter, bool learns)
    : targets_(targets), initial_(initial), density_(density), diameter_(diameter), learns_(learns) {}

double Servo::strain(const Box& box, int axis) const {
    return 1.0 - length(box, axis) / length(initial_, axis);
}

ServoState Servo::begin(const ServoState& before, const Box& box, const std::array<double, 2>& stress,
                        double stress_scale) const {
    ServoState state;
    state.stiffness = before.stiffness > 0.0 ? before.stiffness : stress_scale;
    for (const auto& target : targets_)
        state.stiffness = std::max(state.stiffness, least_stiffness * target.value_or(0.0));
    state.stress = state.begin = state.seen_stress = stress;
    for (std::size_t a = 0; a < 2; ++a)
        state.strain[a] = state.seen_strain[a] = strain(box, static_cast<int>(a));
    return state;
}

double Servo::response_time(const ServoState& state, const Box& box) const {
    double longest = 0.0;
    for (std::size_t a = 0; a < 2; ++a)
        if (targets_[a]) longest = std::max(longest, length(box, static_cast<int>(a)));
    if (box.periodic) longest = std::min(longest, grains_across * diameter_);
    return longest * std::sqrt(density_ / state.stiffness);
}

void Servo::update(ServoState& state, const Box& box, const std::array<double, 2>& stress, double limit,
                   double dt) const {
    const double tau = std::max(response_times * response_time(state, box), fewest_steps * dt);
    const double smooth = share_of(dt, smoothing * tau);
    for (std::size_t a = 0; a < 2; ++a) {
        state.stress[a] += smooth * (stress[a] - state.stress[a]);
        state.strain[a] += smooth * (strain(box, static_cast<int>(a)) - state.strain[a]);
    }
    move_set_point(state, limit, tau, dt);
    const double gain = state.stiffness * tau;
    const double longest = longest_way(state);
    for (std::size_t a = 0; a < 2; ++a) {
        if (!targets_[a]) continue;
        const double way = *targets_[a] - state.begin[a];
        if (std::abs(*targets_[a] - state.stress[a]) <=
            near * std::max(longest, near * std::abs(*targets_[a])))
            state.arrived[a] = 1.0;
        const double lacking = state.begin[a] + state.way * way - state.stress[a];
        if (!learns_ && state.arrived[a] > 0.0 && std::abs(state.rate[a]) < limit)
            state.offset[a] =
                std::clamp(state.offset[a] + lacking / gain * dt / (integral * tau), -limit, limit);
        // Back from beyond the set point it may go faster: the other axis must not carry it along.
        const double most = learns_ && lacking * way < 0.0 ? haste_back * limit : limit;
        state.rate[a] = std::clamp(lacking / gain + state.offset[a], -most, most);
    }
    if (learns_) learn(state, box, dt);
}

double Servo::longest_way(const ServoState& state) const {
    double way = 0.0;
    for (std::size_t a = 0; a < 2; ++a)
        if (targets_[a]) way = std::max(way, std::abs(*targets_[a] - state.begin[a]));
    return way;
}

void Servo::move_set_point(ServoState& state, double limit, double time_constant, double dt) const {
    const double way = longest_way(state);
    const double settled = (1.0 - state.way) * share_of(dt, settling * time_constant);
    const double at_limit = way > 0.0 ? limit * state.stiffness / way * dt : settled;
    state.way += std::min(settled, at_limit);
}

void Servo::learn(ServoState& state, const Box& box, double dt) const {
    // Near the target the stress moves by its own trembling more than by the walls.
    bool arrived = true;
    for (std::size_t a = 0; a < 2; ++a) arrived = arrived && (!targets_[a] || state.arrived[a] > 0.0);
    if (arrived) return;
    state.since_seen += dt;
    const double time = response_time(state, box);
    if (state.since_seen < time) return;
    std::size_t a = targets_[0] ? 0 : 1;
    const auto strained = [&](std::size_t axis) { return state.strain[axis] - state.seen_strain[axis]; };
    if (targets_[0] && targets_[1] && std::abs(strained(1)) > std::abs(strained(0))) a = 1;
    const double target = *targets_[a], stress = std::abs(state.stress[a]);
    const double scale = std::max(stress, carries * target);
    const double change = state.stress[a] - state.seen_stress[a];
    const bool seen = state.stiffness * std::abs(strained(a)) >= noticeable * scale ||
                      (std::abs(change) >= considerable * scale && std::abs(strained(a)) > 0.0);
    if (seen) {
        const double low = stress < carries * target ? 1.0 : most_down;
        state.stiffness =
            std::max(std::clamp(change / strained(a), low * state.stiffness, most_up * state.stiffness),
                     least_stiffness * std::max(target, stress));
    }
    if (seen || state.since_seen > longest_look * time) {
        state.seen_stress = state.stress;
        state.seen_strain = state.strain;
        state.since_seen = 0.0;
    }
}

void ServoState::save(Checkpoint& to) const {
    std::vector<double> values{way, stiffness, since_seen};
    for (const auto* pair : {&stress, &strain, &rate, &offset, &begin, &arrived, &seen_stress, &seen_strain})
        values.insert(values.end(), pair->begin(), pair->end());
    to.put("servo", values);
}

void ServoState::load(const Checkpoint& from) {
    std::vector<double> values;
    from.get("servo", values);
    way = values.at(0);
    stiffness = values.at(1);
    since_seen = values.at(2);
    std::size_t next = 3;
    for (auto* pair : {&stress, &strain, &rate, &offset, &begin, &arrived, &seen_stress, &seen_strain})
        for (double& value : *pair) value = values.at(next++);
}

}  // namespace softgrain
