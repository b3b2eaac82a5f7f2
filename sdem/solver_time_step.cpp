// Largest stable time step.
#include <algorithm>
#include <cmath>
#include <limits>

#include "sdem/solver.hpp"

namespace softgrain::sdem {

/// omega^2 = max over grains of 2 f sum(k_sep)/m + 8 max(kappa, mu)/(rho R^2), and the same sum for damping
/// C: dt = (-C + sqrt(C^2 + 4 omega^2)) / omega^2. Every grain counts at least one contact that just closed.
double SoftDiscSolver::stable_time_step() const {
    const bool rigid = options_.kinematics == Kinematics::D2F0;
    const double f = rigid || options_.incompressible ? 1.0 : 2.0;
    const double bulk = rigid ? 0.0 : std::max(law_.kappa, law_.mu);
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t g = 0; g < size(); ++g) {
        const double m = grains_.mass[g], R = grains_.radius[g];
        double stiffness = 0.0, viscosity = 0.0;
        const auto add = [&](double k_n, double reduced_mass, double share) {
            stiffness += share * k_n;
            viscosity += share * law_.damping * std::sqrt(k_n * reduced_mass);
        };
        for (std::size_t w = 0; w < 4; ++w)
            if ((wall_mask_[g] >> w & 1U) != 0) add(wall_contact_[4 * g + w].force.stiffness, m, 1.0);
        for (const PairsOfGrain::Entry& entry : pairs_of_.of(g)) {
            const auto k = static_cast<std::size_t>(entry.pair);
            if (pair_contact_[k].overlap == Overlap::none) continue;
            const Pair& pair = neighbors_.pairs()[k];
            const double m_i = grains_.mass[static_cast<std::size_t>(pair.i)];
            const double m_j = grains_.mass[static_cast<std::size_t>(pair.j)];
            add(pair_contact_[k].force.stiffness, m_i * m_j / (m_i + m_j), 0.5);
        }
        if (stiffness == 0.0) add(law_.first_stiffness(), m, 1.0);
        const double omega2 = 2.0 * f * stiffness / m + 8.0 * bulk / (density_ * R * R);
        const double C = 2.0 * f * viscosity / m + options_.shape_damping * std::sqrt(law_.E / density_) / R;
        smallest = std::min(smallest, (std::sqrt(C * C + 4.0 * omega2) - C) / omega2);
    }
    // The imposed dilation follows the caps with a delay that damping has to make good (measured, see
    // README.md).
    const double delay = options_.incompressible && !rigid ? std::min(1.0, 0.25 + law_.damping) : 1.0;
    return options_.safety * delay * smallest;
}

}  // namespace softgrain::sdem
