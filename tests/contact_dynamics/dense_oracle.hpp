#pragma once
// Direct solutions of one step of contact. Without friction: the projection of the free velocities, in the
// metric of the masses, onto the velocities that keep all gaps open, which is unique. With friction: the
// linear system of a given set of open, sticking and sliding contacts. residuals() says whether an answer
// obeys the laws.
#include <Eigen/Dense>
#include <Eigen/SparseLU>
#include <cmath>
#include <vector>

#include "contact_problem.hpp"
#include "least_distance.hpp"

namespace softgrain {

/// Impulses of a problem, whatever its friction, as if there were none.
inline Eigen::VectorXd direct_frictionless_impulses(const ContactProblem& problem) {
    // y = M^(1/2) (u - u_free): min |y| with J_n M^(-1/2) y >= -q_n.
    ContactProblem::Matrix normals(problem.size(), 2 * problem.size());
    for (Eigen::Index k = 0; k < problem.size(); ++k) normals.insert(k, 2 * k) = 1.0;
    const ContactProblem::Matrix w =
        normals * problem.delassus() * ContactProblem::Matrix(normals.transpose());
    const Eigen::VectorXd g = -(normals * problem.free_local());
    const std::vector<Eigen::Index> active = active_rows(w, g, problem.u_free.size() / 3 * 2);
    Eigen::VectorXd r = Eigen::VectorXd::Zero(2 * problem.size());
    if (active.empty()) return r;
    const auto count = static_cast<Eigen::Index>(active.size());
    ContactProblem::Matrix chosen(count, problem.size());
    for (Eigen::Index k = 0; k < count; ++k) chosen.insert(k, active[static_cast<std::size_t>(k)]) = 1.0;
    const Eigen::MatrixXd block(chosen * w * ContactProblem::Matrix(chosen.transpose()));
    const Eigen::VectorXd bound = chosen * g;
    const Eigen::LLT<Eigen::MatrixXd> factor(block);
    Eigen::VectorXd p = factor.solve(bound);
    p += factor.solve(bound - block * p);  // one step of refinement
    for (Eigen::Index k = 0; k < count; ++k) r[2 * active[static_cast<std::size_t>(k)]] = p[k];
    return r;
}

/// Impulses with which the active contacts of `guess` keep their gap closed, stick if they are inside their
/// cone by more than `noise` [m/s], and else slide as they do there.
inline Eigen::VectorXd direct_frictional_impulses(const ContactProblem& problem, const Eigen::VectorXd& guess,
                                                  double noise) {
    std::vector<Eigen::Triplet<double>> chosen, impulses;  // equations; impulses r by their unknowns
    int count = 0;
    for (Eigen::Index k = 0; k < problem.size(); ++k) {
        const auto contact = static_cast<std::size_t>(k);
        const int normal = static_cast<int>(2 * k), tangential = normal + 1;
        const double mu = problem.friction[contact], least = noise * problem.reduced_mass[contact];
        if (guess[normal] < least) continue;
        chosen.emplace_back(count, normal, 1.0);
        impulses.emplace_back(normal, count, 1.0);
        if (mu * guess[normal] - std::abs(guess[tangential]) <= least) {
            impulses.emplace_back(tangential, count++, std::copysign(mu, guess[tangential]));
            continue;
        }
        ++count;
        chosen.emplace_back(count, tangential, 1.0);
        impulses.emplace_back(tangential, count++, 1.0);
    }
    ContactProblem::Matrix equation(count, guess.size()), impulse(guess.size(), count);
    equation.setFromTriplets(chosen.begin(), chosen.end());
    impulse.setFromTriplets(impulses.begin(), impulses.end());
    const ContactProblem::Matrix system = equation * problem.delassus() * impulse;
    const Eigen::VectorXd right = -(equation * problem.free_local());
    const Eigen::SparseLU<ContactProblem::Matrix> factor(system);
    if (factor.info() != Eigen::Success) return Eigen::VectorXd::Zero(guess.size());
    Eigen::VectorXd p = factor.solve(right);
    p += factor.solve(right - system * p);  // one step of refinement
    return impulse * p;
}

}  // namespace softgrain
