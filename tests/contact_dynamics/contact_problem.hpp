#pragma once
// One implicit step of contact of all near pairs and walls of a cloud, by brute force and as matrices. Shares
// no code with the solver under test; its residuals judge any solver's answer.
#include <Eigen/Sparse>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "common/box.hpp"
#include "common/contact_dynamics/contact_dynamics.hpp"
#include "disc_cloud.hpp"

namespace softgrain {

/// Velocities u are (v_x, v_y, rim speed) disc by disc [m/s]; impulses r and local velocities w = J u + b are
/// (normal, tangential) contact by contact. Contact law: 0 <= w_n, 0 <= r_n, w_n r_n = 0, Coulomb for w_t,
/// r_t.
struct ContactProblem {
    using Matrix = Eigen::SparseMatrix<double>;

    std::vector<std::pair<int, int>> pairs;  ///< (i, j) with i < j, or (disc, -1 - wall)
    std::vector<double> friction;            ///< [contacts]
    std::vector<double> reduced_mass;        ///< [contacts] [kg]
    Matrix jacobian;                         ///< [2 contacts, 3 discs]
    Eigen::VectorXd offset;                  ///< [2 contacts] b: gap / h less the wall's velocity, and 0
    Eigen::VectorXd inverse_mass, u_free;    ///< [3 discs]

    Eigen::Index size() const { return static_cast<Eigen::Index>(pairs.size()); }
    Eigen::VectorXd velocities(const Eigen::VectorXd& r) const {
        return u_free + inverse_mass.cwiseProduct(jacobian.transpose() * r);
    }
    /// W and q of w = W r + q.
    Matrix delassus() const { return jacobian * inverse_mass.asDiagonal() * Matrix(jacobian.transpose()); }
    Eigen::VectorXd free_local() const { return jacobian * u_free + offset; }
};

/// (v_x, v_y, rim speed) disc by disc.
inline Eigen::VectorXd velocities_of(const DiscCloud& cloud) {
    Eigen::VectorXd u(3 * static_cast<Eigen::Index>(cloud.size()));
    for (std::size_t d = 0; d < cloud.size(); ++d)
        u.segment<3>(3 * static_cast<Eigen::Index>(d)) << cloud.v[d], cloud.rim_speed[d];
    return u;
}

/// All pairs and walls with a gap below `reach`. Discs of two groups rub, walls do not.
inline ContactProblem contact_problem(const DiscCloud& cloud, const WallMotion& walls, double h,
                                      double friction_within, double friction_between, double reach) {
    ContactProblem problem;
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<double> offset;
    const auto n = static_cast<int>(cloud.size());
    // The disc's share of a contact: n . v in the normal row, n turned by +90 degrees in the tangential one,
    // which its rim runs against.
    const auto touch = [&](int disc, const Vec2& normal) {
        const int row = static_cast<int>(offset.size());
        entries.emplace_back(row, 3 * disc, normal.x());
        entries.emplace_back(row, 3 * disc + 1, normal.y());
        entries.emplace_back(row + 1, 3 * disc, -normal.y());
        entries.emplace_back(row + 1, 3 * disc + 1, normal.x());
        entries.emplace_back(row + 1, 3 * disc + 2, -1.0);
    };
    for (int i = 0; i < n; ++i) {
        const auto ui = static_cast<std::size_t>(i);
        for (int j = i + 1; j < n; ++j) {
            const auto uj = static_cast<std::size_t>(j);
            const Vec2 line = cloud.x[uj] - cloud.x[ui];
            const double gap = line.norm() - cloud.radius[ui] - cloud.radius[uj];
            if (gap > reach) continue;
            touch(i, -line.normalized());
            touch(j, line.normalized());
            problem.pairs.emplace_back(i, j);
            problem.friction.push_back(cloud.group[ui] == cloud.group[uj] ? friction_within
                                                                          : friction_between);
            problem.reduced_mass.push_back(1.0 / (1.0 / cloud.mass[ui] + 1.0 / cloud.mass[uj]));
            offset.insert(offset.end(), {gap / h, 0.0});
        }
        for (int wall = 0; wall < 4; ++wall) {
            const double gap = walls.box.distance(wall, cloud.x[ui]) - cloud.radius[ui];
            if (gap > reach) continue;
            touch(i, wall_normal(wall));
            problem.pairs.emplace_back(i, -1 - wall);
            problem.friction.push_back(0.0);
            problem.reduced_mass.push_back(cloud.mass[ui]);
            offset.insert(offset.end(), {gap / h - wall_normal(wall).dot(walls.velocity_of(wall)), 0.0});
        }
    }
    problem.offset =
        Eigen::Map<const Eigen::VectorXd>(offset.data(), static_cast<Eigen::Index>(offset.size()));
    problem.jacobian.resize(problem.offset.size(), 3 * n);
    problem.jacobian.setFromTriplets(entries.begin(), entries.end());
    problem.u_free = velocities_of(cloud);
    problem.inverse_mass.resize(3 * n);
    for (int d = 0; d < n; ++d) {  // a disc: I w = (m r / 2) (w r)
        const double mass = cloud.mass[static_cast<std::size_t>(d)];
        problem.inverse_mass.segment<3>(3 * d) << 1.0 / mass, 1.0 / mass, 2.0 / mass;
    }
    return problem;
}

/// The impulses of the last solve [N s]. Those of contacts that the problem does not know must be zero; they
/// are added up in `unknown`.
inline Eigen::VectorXd impulses_of(const ContactDynamics& contacts, const ContactProblem& problem,
                                   const DiscCloud& cloud, double& unknown) {
    std::map<std::pair<int, int>, Eigen::Index> place;
    for (Eigen::Index k = 0; k < problem.size(); ++k) place[problem.pairs[static_cast<std::size_t>(k)]] = k;
    Eigen::VectorXd r = Eigen::VectorXd::Zero(2 * problem.size());
    unknown = 0.0;
    const auto put = [&](std::pair<int, int> pair, const Vec2& impulse) {
        const auto found = place.find(pair);
        if (found == place.end())
            unknown += impulse.norm();
        else
            r.segment<2>(2 * found->second) = impulse;
    };
    const ContactRows& rows = contacts.rows();
    for (std::size_t k = 0; k < rows.size(); ++k)
        put({rows.i[k], rows.j[k]},
            contacts.reduced_mass(k, cloud.mass) * Vec2(rows.normal[k], rows.tangential_of(k)));
    const WallRows& walls = contacts.wall_rows();
    for (std::size_t k = 0; k < walls.size(); ++k)
        put({walls.disc[k], -1 - walls.wall[k]},
            cloud.mass[static_cast<std::size_t>(walls.disc[k])] * Vec2(walls.normal[k], 0.0));
    return r;
}

/// How far velocities and impulses are from the laws, each as the largest violation of a contact or disc
/// [m/s].
struct ContactResiduals {
    double overlap = 0.0;          ///< gap after the step / h, if negative
    double pull = 0.0;             ///< normal impulse / m_e, if negative
    double complementarity = 0.0;  ///< smaller of the gap after the step / h and the impulse / m_e
    double cone = 0.0;             ///< (|r_t| - mu r_n) / m_e, if positive
    double stick = 0.0;            ///< slip inside the cone
    double wrong_way = 0.0;        ///< slip along the friction
    double momentum = 0.0;         ///< u - u_free - J^T r / m
    int active = 0, sticking = 0, sliding = 0;

    double largest() const {
        return std::max({overlap, pull, complementarity, cone, stick, wrong_way, momentum});
    }
};

/// A contact is active if its impulse / m_e is above `noise` [m/s], and sticks if it is inside its cone by
/// more.
inline ContactResiduals residuals(const ContactProblem& problem, const Eigen::VectorXd& u,
                                  const Eigen::VectorXd& r, double noise) {
    ContactResiduals result;
    const Eigen::VectorXd w = problem.jacobian * u + problem.offset;
    result.momentum = (u - problem.velocities(r)).cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < problem.size(); ++k) {
        const auto contact = static_cast<std::size_t>(k);
        const double opening = w[2 * k], slip = w[2 * k + 1];
        const double normal = r[2 * k] / problem.reduced_mass[contact];
        const double tangential = r[2 * k + 1] / problem.reduced_mass[contact];
        const double room = problem.friction[contact] * normal - std::abs(tangential);
        result.overlap = std::max(result.overlap, -opening);
        result.pull = std::max(result.pull, -normal);
        result.complementarity = std::max(result.complementarity, std::min(opening, normal));
        result.cone = std::max(result.cone, -room);
        if (normal < noise) continue;
        ++result.active;
        if (problem.friction[contact] == 0.0) continue;
        if (room > noise) {
            ++result.sticking;
            result.stick = std::max(result.stick, std::abs(slip));
        } else {
            ++result.sliding;
            result.wrong_way = std::max(result.wrong_way, tangential > 0.0 ? slip : -slip);
        }
    }
    return result;
}

}  // namespace softgrain
