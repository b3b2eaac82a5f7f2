// Contact dynamics beside Siconos' non-smooth Gauss-Seidel: CPU time of one solve of the same contacts, each
// from its discs or matrices to its velocities. Prints CSV; `residual` is the largest of the contact laws
// (see residuals()).
#include <fmt/format.h>
#include <omp.h>

#include <ctime>

#include "contact_problem.hpp"
#include "siconos_input.hpp"

namespace softgrain {
namespace {

constexpr double reach = 0.5;   // gaps that are looked at [m]
constexpr double noise = 1e-7;  // impulses / m_e above it are an active contact [m/s]

double cpu_seconds() {
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void compare(int side, double friction) {
    constexpr double h = SqueezedCloud::h, tolerance = 1e-8;
    SqueezedCloud squeezed(3, side, side, 4);
    const ContactProblem problem =
        contact_problem(squeezed.cloud, squeezed.walls, h, friction, friction, reach);

    SiconosInput input(problem);
    const SiconosProblem siconos = input.problem();
    Eigen::VectorXd theirs(2 * problem.size());
    int iterations = 0;
    const double start = cpu_seconds();
    const int code = siconos_solve(&siconos, tolerance, 100000, theirs.data(), &iterations);
    const double siconos_seconds = cpu_seconds() - start;
    const double siconos_residual = residuals(problem, problem.velocities(theirs), theirs, noise).largest();

    ContactDynamics contacts({.tolerance = tolerance,
                              .skin = reach,
                              .max_iterations = 100000,
                              .within = {.friction = friction},
                              .between = {.friction = friction}});
    const double our_start = cpu_seconds();
    const bool converged = contacts.solve(squeezed.cloud.discs(), squeezed.walls, h).converged;
    const double our_seconds = cpu_seconds() - our_start;
    double unknown = 0.0;
    const Eigen::VectorXd ours = impulses_of(contacts, problem, squeezed.cloud, unknown);
    const double our_residual = residuals(problem, velocities_of(squeezed.cloud), ours, noise).largest();
    if (code != 0 || !converged) return;
    fmt::print("{},{:g},{:.6f},{:.6f},{:.3g},{:.3g}\n", side * side, friction, our_seconds, siconos_seconds,
               our_residual, siconos_residual);
}

}  // namespace
}  // namespace softgrain

int main() {
    omp_set_num_threads(1);
    fmt::print("discs,friction,softgrain_seconds,siconos_seconds,softgrain_residual,siconos_residual\n");
    for (const int side : {20, 40})
        for (const double friction : {0.0, 0.3}) softgrain::compare(side, friction);
}
