// Largest stable time step.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

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
    if (has_potential()) {
        resistance_.resize(contacts_);
#pragma omp parallel for schedule(static) if (threads_pay_off())
        for (std::size_t block = 0; block < blocks(); ++block) {
            const std::size_t begin = block * grains_per_block;
            std::array<std::size_t, grains_per_block> grain;
            std::iota(grain.begin(), grain.end(), begin);
            find_resistances(grains_, contacts_, pressures_.inflated, resistance_,
                             std::span(grain).first(std::min(size() - begin, grains_per_block)));
        }
    }
    double smallest = std::numeric_limits<double>::infinity();
#pragma omp parallel for schedule(static) reduction(min : smallest) if (threads_pay_off())
    for (std::size_t g = 0; g < size(); ++g) smallest = std::min(smallest, grain_time_step(g));
    return time_step_share() * smallest;
}

/// The same for the grains with a contact that has just closed.
double SoftDiscSolver::disturbed_time_step_limit() {
    if (has_potential()) resist_disturbed();
    double smallest = std::numeric_limits<double>::infinity();
    for (const std::size_t g : disturbed_) smallest = std::min(smallest, grain_time_step(g));
    return time_step_share() * smallest;
}

/// Resistances at all contacts of the disturbed grains, on both sides.
void SoftDiscSolver::resist_disturbed() {
    resistance_.resize(contacts_);
    std::vector<std::size_t> grain;
    for (const std::size_t g : disturbed_) {
        grain.push_back(g);
        contact_view().each_side_of(g, [&](const Side& side) {
            if (!side.wall()) grain.push_back(static_cast<std::size_t>(side.other));
        });
    }
    for (std::size_t begin = 0; begin < grain.size(); begin += grains_per_block)
        find_resistances(grains_, contacts_, pressures_.inflated, resistance_,
                         std::span(grain).subspan(begin, std::min(grain.size() - begin, grains_per_block)));
}

/// omega^2 = 2 f sum(k_sep)/m + 8 K/(rho b^2), and the same sum for damping C: dt = (-C + sqrt(C^2 + 4
/// omega^2)) / omega^2. Every grain counts at least one contact that just closed.
double SoftDiscSolver::grain_time_step(std::size_t g) const {
    const MotionLaw& law = options_.motion;
    const bool rigid = law.kinematics == Kinematics::D2F0;
    const double f = rigid || law.imposes_area ? 1.0 : 2.0;
    const Grain& grain = grains_.grain[g];
    const GrainMaterial& material = grains_.material_of(g);
    const double m = grain.mass;
    double stiffness = 0.0, viscosity = 0.0;
    contact_view().each_side_of(g, [&](const Side& side) {
        const auto other = static_cast<std::size_t>(side.wall() ? 0 : side.other);
        const double m_other = grains_.grain[other].mass;
        const double reduced = side.wall() ? m : m * m_other / (m + m_other), part = side.wall() ? 1.0 : 0.5;
        // Half the depth of a shallow lens, or all of it at a wall: S = 2/3 L depth.
        const double length2 = side.contact.length_squared(), length = std::sqrt(length2);
        const double delta = std::min(part * 1.5 * side.contact.lens() / length, 0.25 * length);
        const double E = side.wall() ? material.E : std::max(material.E, grains_.material_of(other).E);
        const double k_n = Mollon2022::stiffness(E, length, delta);
        viscosity += part * options_.contact_damping * std::sqrt(k_n * reduced);
        if (has_potential()) {
            const double share_i = side.second ? 1.0 - side.share : side.share, share_j = 1.0 - share_i;
            const double against = side.wall() ? resistance_.wall[side.index]
                                               : share_i * share_i * resistance_.pair[side.index].i +
                                                     share_j * share_j * resistance_.pair[side.index].j;
            // The chord grows with the root of the depth.
            stiffness += length2 * (against + std::max(0.0, side.contact.q) / (3.0 * side.contact.lens()));
        } else {
            stiffness += part * k_n;
        }
        if (options_.sliding.slides()) stiffness += options_.sliding.stiffness * E;
    });
    if (stiffness == 0.0) stiffness = Mollon2022::first_stiffness(material.E);
    const double bulk =
        rigid ? 0.0 : std::max(material.kappa / (1.0 + material.dilation_inertia), material.mu);
    const double smaller = std::min(grain.a, grain.b);
    const double omega2 = 2.0 * f * stiffness / m + 8.0 * bulk / (material.density * smaller * smaller);
    const double C = 2.0 * f * viscosity / m + material.shape_damping / grain.radius;
    return (std::sqrt(C * C + 4.0 * omega2) - C) / omega2;
}

}  // namespace softgrain::sdem
