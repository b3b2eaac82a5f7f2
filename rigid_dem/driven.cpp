// Grains that move as they are told. Their inverse mass is zero, and the forces on them are taken away before
// the grains move.
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

void RigidDem::start_driven() {
    for (std::size_t d = 0; d < driven_.size(); ++d) {
        GrainRecord& g = record_[driven_record_[d]];
        const Vec2 v = driven_[d].velocity_at({g.x, g.y});
        g.vx = v.x();
        g.vy = v.y();
        g.spin = driven_[d].spin;
        g.rim_speed = g.spin * g.radius;
    }
}

/// From where they are at `time` to where they are dt later, at the mean velocity.
void RigidDem::move_driven(double time, double dt) {
    for (std::size_t d = 0; d < driven_.size(); ++d) {
        GrainRecord& g = record_[driven_record_[d]];
        const Vec2 before = driven_[d].position(driven_start_[d], time);
        const Vec2 x = driven_[d].position(driven_start_[d], time + dt), v = (x - before) / dt;
        g.x = x.x();
        g.y = x.y();
        g.vx = v.x();
        g.vy = v.y();
    }
}

void RigidDem::take_driven_forces() {
    for (std::size_t d = 0; d < driven_.size(); ++d) {
        if (rest_.used() && rest_.resting(block_of(driven_record_[d]))) continue;
        ForceSum& force = force_[driven_record_[d]];
        driven_force_[d] = force;
        force = {};
    }
}

/// On the grains, by forces of this kind on the driven ones during a step [J].
double RigidDem::driven_work(const std::vector<ForceSum>& force, double dt) const {
    double power = 0.0;
    for (std::size_t d = 0; d < driven_.size(); ++d) {
        const GrainRecord& g = record_[driven_record_[d]];
        const ForceSum& f = force[d];
        power -= f.fx * g.vx + f.fy * g.vy + (g.radius * f.shear - f.lost_torque) * g.spin;
    }
    return power * dt;
}

}  // namespace softgrain::rigid_dem
