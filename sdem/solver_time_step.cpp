// Largest stable time step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/mollon2022.hpp"
#include "sdem/solver.hpp"

namespace softgrain::sdem {

/// Share of the stability limit that is used.
double SoftDiscSolver::time_step_share() const {
    // The imposed dilation follows the caps with a delay that damping has to make good (measured, see
    // README.md).
    const double delay = options_.motion.imposes_area ? std::min(1.0, 0.25 + options_.contact_damping) : 1.0;
    return options_.safety * delay;
}

double SoftDiscSolver::time_step_limit() {
    SideValues& resistance = rest_.used() ? resistance_ : pressures_.side;
    if (has_potential()) {
        resistance.resize(contacts_);
        const Chunks grains = blocks();
#pragma omp parallel for schedule(static) if (threads_pay_off())
        for (std::size_t block = 0; block < grains.count(); ++block)
            find_resistances(grains_, contacts_, pressures_.inflated, resistance, grains.begin(block),
                             grains.end(block));
    }
    restraint_.resize(size());
    double smallest = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : smallest) if (threads_pay_off())
    for (std::size_t g = 0; g < size(); ++g) {
        Restraint sum;
        contact_view().each_side_of(g, [&](const Side& side) {
            const std::size_t k = side.index;
            if (!has_potential())
                sum.add(side.wall() ? wall_restraint(k, 0.0) : pair_restraint(k, 0.0, 0.0));
            else if (side.wall())
                sum.add(wall_restraint(k, resistance.wall[k]));
            else
                sum.add(pair_restraint(k, resistance.pair[k].i, resistance.pair[k].j));
        });
        restraint_[g] = sum;
        smallest = std::min(smallest, grain_time_step(g, sum));
    }
    return time_step_share() * smallest;
}

/// Shortens the time step where contacts have just closed. Grains that may need it are told by what was last
/// known of them and all that closed since, and then looked at afresh.
void SoftDiscSolver::heed_closed_contacts() {
    std::vector<std::size_t> touched;
    const auto note = [&](int grain, const Restraint& fresh) {
        touched.push_back(static_cast<std::size_t>(grain));
        restraint_[touched.back()].add(fresh);
    };
    for (const std::size_t k : closed_pairs_) {
        const Restraint fresh = pair_restraint(k);
        note(contacts_.pairs()[k].i, fresh);
        note(contacts_.pairs()[k].j, fresh);
    }
    for (const std::size_t w : closed_walls_) note(contacts_.wall_pairs()[w].grain, wall_restraint(w));
    const double before = time_step_;
    for (const std::size_t g : touched) {
        if (time_step_share() * grain_time_step(g, restraint_[g]) >= before) continue;
        Restraint sum;
        contact_view().each_side_of(g, [&](const Side& side) {
            sum.add(side.wall() ? wall_restraint(side.index) : pair_restraint(side.index));
        });
        restraint_[g] = sum;
        time_step_ = std::min(time_step_, time_step_share() * grain_time_step(g, sum));
    }
}

double SoftDiscSolver::resistance(std::size_t g, double overlap) const {
    return has_potential() ? resistance_of(grains_, pressures_.inflated, g, overlap) : 0.0;
}

SoftDiscSolver::Restraint SoftDiscSolver::pair_restraint(std::size_t k) const {
    const double lens = contacts_.pair_contact[k].lens(), share = contacts_.share[k];
    return pair_restraint(k, resistance(static_cast<std::size_t>(contacts_.pairs()[k].i), share * lens),
                          resistance(static_cast<std::size_t>(contacts_.pairs()[k].j), (1.0 - share) * lens));
}

SoftDiscSolver::Restraint SoftDiscSolver::wall_restraint(std::size_t w) const {
    return wall_restraint(w, resistance(static_cast<std::size_t>(contacts_.wall_pairs()[w].grain),
                                        contacts_.wall_contact[w].lens()));
}

SoftDiscSolver::Restraint SoftDiscSolver::pair_restraint(std::size_t k, double resistance_i,
                                                         double resistance_j) const {
    const auto i = static_cast<std::size_t>(contacts_.pairs()[k].i),
               j = static_cast<std::size_t>(contacts_.pairs()[k].j);
    const double m_i = grains_.grain[i].mass, m_j = grains_.grain[j].mass;
    const double share_i = contacts_.share[k], share_j = 1.0 - share_i;
    return restraint_of(
        contacts_.pair_contact[k], share_i * share_i * resistance_i + share_j * share_j * resistance_j, 0.5,
        std::max(grains_.material_of(i).E, grains_.material_of(j).E), m_i * m_j / (m_i + m_j));
}

SoftDiscSolver::Restraint SoftDiscSolver::wall_restraint(std::size_t w, double resistance) const {
    const auto g = static_cast<std::size_t>(contacts_.wall_pairs()[w].grain);
    return restraint_of(contacts_.wall_contact[w], resistance, 1.0, grains_.material_of(g).E,
                        grains_.grain[g].mass);
}

/// resistance: dq/dS, lens potential only; part: of the overlap that one side is.
SoftDiscSolver::Restraint SoftDiscSolver::restraint_of(const Contact& c, double resistance, double part,
                                                       double E, double reduced_mass) const {
    // Half the depth of a shallow lens, or all of it at a wall: S = 2/3 L depth.
    const double length2 = c.length_squared(), length = std::sqrt(length2);
    const double delta = std::min(part * 1.5 * c.lens() / length, 0.25 * length);
    const double k_n = Mollon2022::stiffness(E, length, delta);
    double stiffness = part * k_n;
    // The chord grows with the root of the depth. A shallow contact counts as what it soon will be.
    if (has_potential())
        stiffness = std::max(stiffness, length2 * (resistance + std::max(0.0, c.q) / (3.0 * c.lens())));
    if (options_.sliding.slides()) stiffness += options_.sliding.stiffness * E;
    return {stiffness, part * options_.contact_damping * std::sqrt(k_n * reduced_mass)};
}

/// omega^2 = 2 f sum(k_sep)/m + 8 K/(rho b^2), and the same sum for damping C: dt = (-C + sqrt(C^2 + 4
/// omega^2)) / omega^2. Every grain counts at least one contact that just closed.
double SoftDiscSolver::grain_time_step(std::size_t g, const Restraint& contacts) const {
    const MotionLaw& law = options_.motion;
    const bool rigid = law.kinematics == Kinematics::D2F0;
    const double f = rigid || law.imposes_area ? 1.0 : 2.0;
    const Grain& grain = grains_.grain[g];
    const GrainMaterial& material = grains_.material_of(g);
    const double stiffness =
        contacts.stiffness > 0.0 ? contacts.stiffness : Mollon2022::first_stiffness(material.E);
    const double bulk =
        rigid ? 0.0 : std::max(material.kappa / (1.0 + material.dilation_inertia), material.mu);
    const double smaller = std::min(grain.a, grain.b);
    const double omega2 =
        2.0 * f * stiffness / grain.mass + 8.0 * bulk / (material.density * smaller * smaller);
    const double C = 2.0 * f * contacts.viscosity / grain.mass + material.shape_damping / grain.radius;
    return (std::sqrt(C * C + 4.0 * omega2) - C) / omega2;
}

}  // namespace softgrain::sdem
