#pragma once
// Direct solution of one step of frictionless contact: the projection of the free velocities, in the metric
// of the masses, onto the velocities that keep all gaps open. Least-distance problem by non-negative least
// squares (Lawson and Hanson 1974, chapter 23); shares no code with the solver under test.
#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "common/box.hpp"
#include "disc_cloud.hpp"

namespace softgrain {

/// min |A x - b| with x >= 0.
inline Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
    const Eigen::Index n = a.cols();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    std::vector<Eigen::Index> passive;
    const double small = 1e-13 * b.norm();
    for (int round = 0; round < 10 * n; ++round) {
        const Eigen::VectorXd gradient = a.transpose() * (b - a * x);
        Eigen::Index best = -1;
        for (Eigen::Index k = 0; k < n; ++k) {
            const bool free = std::find(passive.begin(), passive.end(), k) == passive.end();
            if (free && gradient[k] > small && (best < 0 || gradient[k] > gradient[best])) best = k;
        }
        if (best < 0) break;
        passive.push_back(best);
        while (!passive.empty()) {
            Eigen::MatrixXd part(a.rows(), static_cast<Eigen::Index>(passive.size()));
            for (std::size_t k = 0; k < passive.size(); ++k)
                part.col(static_cast<Eigen::Index>(k)) = a.col(passive[k]);
            const Eigen::VectorXd s = part.completeOrthogonalDecomposition().solve(b);
            double length = 1.0;
            for (std::size_t k = 0; k < passive.size(); ++k) {
                const double now = x[passive[k]], next = s[static_cast<Eigen::Index>(k)];
                if (next <= 0.0) length = std::min(length, now / (now - next));
            }
            std::vector<Eigen::Index> kept;
            for (std::size_t k = 0; k < passive.size(); ++k) {
                double& now = x[passive[k]];
                now += length * (s[static_cast<Eigen::Index>(k)] - now);
                if (now > 1e-15)
                    kept.push_back(passive[k]);
                else
                    now = 0.0;
            }
            passive.swap(kept);
            if (length == 1.0) break;
        }
    }
    return x;
}

/// Velocities after contact of all pairs and all walls, dense.
inline std::vector<Vec2> dense_contact_velocities(const DiscCloud& cloud, const WallMotion& walls, double h) {
    const auto n = static_cast<Eigen::Index>(cloud.size());
    std::vector<Eigen::VectorXd> rows;
    std::vector<double> bounds;  // row . v >= bound
    for (Eigen::Index i = 0; i < n; ++i) {
        const auto ui = static_cast<std::size_t>(i);
        for (Eigen::Index j = i + 1; j < n; ++j) {
            const auto uj = static_cast<std::size_t>(j);
            const Vec2 line = cloud.x[uj] - cloud.x[ui];
            const double gap = line.norm() - cloud.radius[ui] - cloud.radius[uj];
            if (gap > 1.0) continue;
            Eigen::VectorXd row = Eigen::VectorXd::Zero(2 * n);
            row.segment<2>(2 * j) = line.normalized();
            row.segment<2>(2 * i) = -line.normalized();
            rows.push_back(row);
            bounds.push_back(-gap / h);
        }
        for (int wall = 0; wall < 4; ++wall) {
            Eigen::VectorXd row = Eigen::VectorXd::Zero(2 * n);
            row.segment<2>(2 * i) = wall_normal(wall);
            rows.push_back(row);
            bounds.push_back(-(walls.box.distance(wall, cloud.x[ui]) - cloud.radius[ui]) / h +
                             wall_normal(wall).dot(walls.velocity_of(wall)));
        }
    }
    // y = M^(1/2) (v - v_free): min |y| with G y >= g.
    const auto m = static_cast<Eigen::Index>(rows.size());
    Eigen::VectorXd root_mass(2 * n), v_free(2 * n);
    for (Eigen::Index i = 0; i < n; ++i) {
        root_mass.segment<2>(2 * i).setConstant(std::sqrt(cloud.mass[static_cast<std::size_t>(i)]));
        v_free.segment<2>(2 * i) = cloud.v[static_cast<std::size_t>(i)];
    }
    Eigen::MatrixXd e(2 * n + 1, m);
    for (Eigen::Index k = 0; k < m; ++k) {
        const Eigen::VectorXd& row = rows[static_cast<std::size_t>(k)];
        e.col(k).head(2 * n) = row.cwiseQuotient(root_mass);
        e(2 * n, k) = bounds[static_cast<std::size_t>(k)] - row.dot(v_free);
    }
    Eigen::VectorXd f = Eigen::VectorXd::Zero(2 * n + 1);
    f[2 * n] = 1.0;
    const Eigen::VectorXd r = e * non_negative_least_squares(e, f) - f;
    const Eigen::VectorXd v = v_free - (r.head(2 * n) / r[2 * n]).cwiseQuotient(root_mass);
    std::vector<Vec2> result;
    for (Eigen::Index i = 0; i < n; ++i) result.emplace_back(v.segment<2>(2 * i));
    return result;
}

}  // namespace softgrain
