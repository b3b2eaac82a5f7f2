#include "rigid_dem/wall_contacts.hpp"

namespace softgrain::rigid_dem {

double wall_overlap(const GrainRecord& grain, int wall, const Box& box) {
    return grain.radius - box.distance(wall, {grain.x, grain.y});
}

ContactForce wall_force(WallContact& contact, const GrainRecord& grain, const WallMotion& walls,
                        const Parameters& law, double dt) {
    const Vec2 n = -wall_normal(contact.wall);
    const Vec2 against = walls.velocity_of(contact.wall) - Vec2{grain.vx, grain.vy};
    const double overlap = wall_overlap(grain, contact.wall, walls.box);
    const ContactInput in{
        .overlap = overlap,
        .closing = -against.dot(n),
        .slip = against.dot(perpendicular(n)) - grain.rim_speed + 0.5 * overlap * grain.spin,
        .spin_difference = grain.spin,
        .k = contact.stiffness.k,
        .shear_ratio = contact.stiffness.shear_ratio,
        .shear_compliance = 1.0 / (contact.stiffness.shear_ratio * contact.stiffness.k),
        .inverse_mass = grain.inverse_mass,
        .rolling_radius = grain.radius,
        .adhesive_length = 2.0 * grain.radius};
    constexpr unsigned features = has_damping | has_friction | has_rolling;
    return law.hertz ? contact_force<Hertz, features>(in, contact.memory, law.at_walls, dt)
                     : contact_force<Linear, features>(in, contact.memory, law.at_walls, dt);
}

WallSums press_on_walls(std::vector<WallContact>& contacts, const std::vector<GrainRecord>& grain,
                        std::vector<ForceSum>& force, const WallMotion& walls, const Parameters& law,
                        double dt) {
    WallSums sums;
    for (WallContact& contact : contacts) {
        const GrainRecord& g = grain[contact.record];
        const ContactForce answer = wall_force(contact, g, walls, law, dt);
        const Vec2 n = -wall_normal(contact.wall);
        const Vec2 on_grain = answer.shear * perpendicular(n) - answer.normal * n;
        const double overlap = wall_overlap(g, contact.wall, walls.box);
        ForceSum& sum = force[contact.record];
        sum.fx += on_grain.x();
        sum.fy += on_grain.y();
        sum.shear += answer.shear;
        sum.lost_torque += 0.5 * answer.shear * overlap - answer.moment;
        sums.force[contact.wall] -= on_grain;
        sums.friction_loss += answer.friction_loss;
        sums.damping_loss += answer.damping_loss;
        sums.overlap = std::max(sums.overlap, overlap);
    }
    return sums;
}

}  // namespace softgrain::rigid_dem
