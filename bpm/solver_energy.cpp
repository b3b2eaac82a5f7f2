// The energy ledger of the solver.
#include "bpm/solver.hpp"
#include "common/at.hpp"
#include "common/block_sum.hpp"

namespace softgrain::bpm {

void BpmSolver::account(const WallMotion& walls, double h) {
    double work = 0.0;
    for (int w = 0; w < 4; ++w) work -= h * wall_force_[at(w)].dot(walls.velocity_of(w));
    // The contact impulses p = m (v+ - v-) - h F gave the discs the kinetic energy p.(v- + v+)/2.
    double given = block_sum(x_.size(), threads_.parallel(), [&](std::size_t d) {
        const Vec2 impulse = mass_[d] * (v_[d] - v_before_[d]) - h * force_[d];
        return 0.5 * impulse.dot(v_[d] + v_before_[d]);
    });
    if (rubs_)
        given += block_sum(x_.size(), threads_.parallel(), [&](std::size_t d) {
            return 0.25 * mass_[d] * (rim_speed_[d] - rim_speed_before_[d]) *
                   (rim_speed_[d] + rim_speed_before_[d]);
        });
    if (box2d_) {
        double corrections = 0.0;
        for (std::size_t d = 0; d < x_.size(); ++d)
            corrections -= force_[d].dot(x_[d] - x_before_[d] - h * v_[d]);
        correction_energy_ += corrections;
        given += corrections;
    }
    double rubbed = 0.0;
    if (rubs_) {
        const SolvedContacts solved = solved_contacts();
        const ContactRows& rows = solved.rows;
        for (std::size_t k = 0; k < rows.size(); ++k) {
            const double c = rows.rolling.empty() ? 0.0 : rows.rolling[k];
            if (rows.tangential[k] == 0.0 && c == 0.0) continue;
            const std::size_t i = at(rows.i[k]);
            const std::size_t j = at(rows.j[k]);
            const double rim_i = rim_speed_[i] + rim_speed_before_[i];
            const double rim_j = rim_speed_[j] + rim_speed_before_[j];
            const Vec2 t = perpendicular(rows.direction[k]);
            const double slip = t.dot(v_[j] + v_before_[j] - v_[i] - v_before_[i]) - rim_i - rim_j;
            const double roll = rim_j / radius_[j] - rim_i / radius_[i];
            rubbed -= 0.5 * (slip * rows.tangential[k] + roll * c) * solved.reduced_mass(k, mass_);
        }
    }
    if (bonds_) energy_.damping += h * bonds_->damping_power(x_, v_before_, v_);
    energy_.external_work += work;
    energy_.friction += rubbed;
    energy_.impact += work - given - rubbed;
}

double BpmSolver::kinetic_energy() const {
    double sum = 0.0;
    for (std::size_t d = 0; d < v_.size(); ++d)
        sum += mass_[d] * (0.5 * v_[d].squaredNorm() + 0.25 * rim_speed_[d] * rim_speed_[d]);
    return sum;
}

/// Since the start of the run.
double BpmSolver::work_of_gravity() const {
    if (gravity_.isZero(0.0)) return 0.0;
    double work = 0.0;
    for (std::size_t d = 0; d < x_.size(); ++d) work += mass_[d] * gravity_.dot(x_[d] - x_start_[d]);
    return work;
}

double BpmSolver::inner_energy() {
    return bonds_ ? bonds_->energy(x_) : attraction_.energy(x_);
}

}  // namespace softgrain::bpm
