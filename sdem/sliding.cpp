#include "sdem/sliding.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::sdem {
namespace {

/// What the two sides of a contact make of the law.
struct Grip {
    double friction;  ///< coefficient
    double spring;    ///< stiffness along the chord [N/m]
    double build_up;  ///< adhesive stress gained per overlap area lost [N/m^3]
};

double adhesion_per_area(const SlidingLaw& law, double area) {
    return law.adhesion_range > 0.0 ? law.cohesion / (law.adhesion_range * area) : 0.0;
}

Grip grip_of(const SlidingLaw& law, const Grains& grains, const Pair& pair) {
    const auto i = static_cast<std::size_t>(pair.i), j = static_cast<std::size_t>(pair.j);
    const double E_i = grains.material_of(i).E, E_j = grains.material_of(j).E;
    const double area = std::min(grains.grain[i].reference_area(), grains.grain[j].reference_area());
    return {law.friction, law.stiffness * 2.0 * E_i * E_j / (E_i + E_j), adhesion_per_area(law, area)};
}

Grip grip_of(const SlidingLaw& law, const Grains& grains, const WallPair& pair) {
    const auto g = static_cast<std::size_t>(pair.grain);
    return {law.wall_friction, law.stiffness * grains.material_of(g).E,
            adhesion_per_area(law, grains.grain[g].reference_area())};
}

SlidingWork slide(const SlidingLaw& law, const Grip& grip, Contact& c, ContactHistory& history, std::size_t k,
                  double dt) {
    SlidingWork work;
    const double normal = c.q + damping_without_pull(c.q, c.q_damping);
    const double lens = c.lens();
    if (law.cohesion > 0.0 && law.adhesion_range > 0.0) {
        double& adhesion = history.adhesion[k];
        if (dt > 0.0) {
            // A slider between 0 and the cohesion, driven by the loss of overlap.
            const double trial = adhesion - grip.build_up * (lens - history.lens[k]);
            const double now = c.touching() ? std::clamp(trial, 0.0, law.cohesion) : 0.0;
            work.adhesion = c.touching() ? now * std::abs(trial - now) / grip.build_up
                                         : 0.5 * adhesion * adhesion / grip.build_up;
            adhesion = now;
            history.lens[k] = lens;
        }
        c.q -= adhesion;
    } else if (c.touching()) {
        c.q -= law.cohesion;
    }
    if (law.slides()) {
        double& spring = history.spring[k];
        if (!c.touching()) {
            work.friction = 0.5 * grip.spring * spring * spring;
            spring = 0.0;
            history.tangential[k] = 0.0;
            return work;
        }
        const double length = std::sqrt(c.length_squared());
        const double most = grip.friction * length * std::max(0.0, normal);
        if (dt == 0.0) return work;
        const double trial = spring + dt * history.slip_rate[k];
        const double force = std::clamp(grip.spring * trial, -most, most);
        spring = force / grip.spring;
        work.friction = std::abs(force * (trial - spring));
        history.tangential[k] = -force / length;
    }
    return work;
}

/// Energy of contact k's spring and adhesion [J].
double stored(const SlidingLaw& law, const Grip& grip, const Contact& c, const ContactHistory& history,
              std::size_t k) {
    double sum = 0.0;
    if (law.slides()) sum += 0.5 * grip.spring * history.spring[k] * history.spring[k];
    if (law.cohesion > 0.0)
        sum += grip.build_up > 0.0 ? 0.5 * history.adhesion[k] * history.adhesion[k] / grip.build_up
                                   : -law.cohesion * c.lens();
    return sum;
}

}  // namespace

SlidingWork slide_pairs(const SlidingLaw& law, const Grains& grains, ContactList& list, double dt,
                        std::size_t begin, std::size_t end) {
    SlidingWork sum;
    for (std::size_t k = begin; k < end; ++k)
        sum.add(slide(law, grip_of(law, grains, list.pairs()[k]), list.pair_contact[k], list.pair_history, k,
                      dt));
    return sum;
}

SlidingWork slide_walls(const SlidingLaw& law, const Grains& grains, ContactList& list, double dt,
                        std::size_t begin, std::size_t end) {
    SlidingWork sum;
    for (std::size_t k = begin; k < end; ++k)
        sum.add(slide(law, grip_of(law, grains, list.wall_pairs()[k]), list.wall_contact[k],
                      list.wall_history, k, dt));
    return sum;
}

double stored_energy(const SlidingLaw& law, const Grains& grains, const ContactList& list) {
    double sum = 0.0;
    for (std::size_t k = 0; k < list.pairs().size(); ++k)
        sum += stored(law, grip_of(law, grains, list.pairs()[k]), list.pair_contact[k], list.pair_history, k);
    for (std::size_t k = 0; k < list.wall_pairs().size(); ++k)
        sum += stored(law, grip_of(law, grains, list.wall_pairs()[k]), list.wall_contact[k],
                      list.wall_history, k);
    return sum;
}

}  // namespace softgrain::sdem
