// The largest stable time step of clumps, as in time_step.cpp: the stiffness matrix is below twice what each
// clump has for itself, K = sum of k b b' over normal and tangential springs, b = (direction, lever about its
// centre). Of this 3 x 3 matrix, in units of mass and inertia, the largest eigenvalue is taken.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

/// Bound on omega^2 of all clumps, for the contacts they have and two that each may have soon.
double RigidDem::frequency2_of_clumps() const {
    std::vector<Eigen::Matrix3d> stiffness(clumps_->size(), Eigen::Matrix3d::Zero());
    const bool grips = (law_.features & has_friction) != 0 || law_.at_walls.friction > 0.0;
    const auto add_spring = [&](std::size_t clump, double k, const Vec2& direction, double lever) {
        const double per_root_mass = 1.0 / std::sqrt(clumps_->mass()[clump]);
        const Eigen::Vector3d b{direction.x() * per_root_mass, direction.y() * per_root_mass,
                                lever / std::sqrt(clumps_->moment_of_inertia(clump))};
        stiffness[clump] += k * b * b.transpose();
    };
    // n points out of the disc; `share` of what the contact stores that counts for it.
    const auto add_contact = [&](std::size_t disc, double share, double k, double shear_ratio,
                                 const Vec2& n) {
        const std::size_t clump = clumps_->owner(disc);
        const Vec2 arm = clumps_->arm_now(disc), s = perpendicular(n);
        const double R = radius_[disc], k_t = grips ? shear_ratio * k : 0.0;
        add_spring(clump, share * k, n, cross(arm, n));
        if (k_t == 0.0) return;
        add_spring(clump, share * k_t, s, cross(arm, s) + R);
        const double roller = law_.between_grains.rolling_stiffness * k_t * R * R;
        add_spring(clump, share * roller, Vec2::Zero(), 1.0);
    };
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        each_pair(block, [&](std::size_t i, std::size_t j, std::size_t p) {
            const double into = overlap(block, p);
            if (into <= 0.0 && (block.bond.empty() || block.bond[p] == 0.0)) return;
            const GrainRecord &from = record(block, block.pairs[p].i), &to = record(block, block.pairs[p].j);
            const Vec2 n = Vec2{to.x - from.x, to.y - from.y}.normalized();
            const ContactStiffness own = stiffness_of(block, p);
            const double k = tangent_stiffness(own.k, into);
            add_contact(i, 2.0, k, own.shear_ratio, n);
            add_contact(j, 2.0, k, own.shear_ratio, -n);
        });
        for (const WallContact& contact : wall_contacts_[b]) {
            const double into = wall_overlap(record_[contact.record], contact.wall, box_);
            if (into > 0.0)
                add_contact(grain_of(block, contact), 1.0, tangent_stiffness(contact.stiffness.k, into),
                            contact.stiffness.shear_ratio, -wall_normal(contact.wall));
        }
    }
    double largest = 0.0;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    for (const Eigen::Matrix3d& K : stiffness)
        largest = std::max(largest, solver.computeDirect(K, Eigen::EigenvaluesOnly).eigenvalues()[2]);
    for (std::size_t d = 0; d < clumps_->discs(); ++d) {
        const std::size_t clump = clumps_->owner(d);
        const double per_mass = 1.0 / clumps_->mass()[clump],
                     per_inertia = 1.0 / clumps_->moment_of_inertia(clump);
        const double k = stiffness_soon(d, clumps_->mass()[clump]), arm = clumps_->arm(d),
                     most = arm + radius_[d];
        const double k_t = grips ? stiffness_at_wall(law_, elasticity_of(d)).shear_ratio * k : 0.0;
        const double one =
            k * (per_mass + arm * arm * per_inertia) + k_t * (per_mass + most * most * per_inertia);
        largest = std::max(largest, 2.0 * 2.0 * one);
    }
    return largest;
}

}  // namespace softgrain::rigid_dem
