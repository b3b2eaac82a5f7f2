#include "rigid_dem/wall_contacts.hpp"

#include <stdexcept>

namespace softgrain::rigid_dem {
namespace {

template <class Normal, unsigned features>
ContactForce force_at_wall(WallContact& contact, const GrainRecord& grain, const WallMotion& walls,
                           const LawConstants& law, double dt) {
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
    return contact_force<Normal, features>(in, contact.memory, law, dt);
}

template <class Normal, unsigned features>
WallSums press(std::vector<WallContact>& contacts, const std::vector<GrainRecord>& grain,
               std::vector<ForceSum>& force, const WallMotion& walls, const LawConstants& law, double dt) {
    WallSums sums;
    for (WallContact& contact : contacts) {
        const GrainRecord& g = grain[contact.record];
        const ContactForce answer = force_at_wall<Normal, features>(contact, g, walls, law, dt);
        const Vec2 n = -wall_normal(contact.wall);
        const Vec2 on_grain = answer.shear * perpendicular(n) - answer.normal * n;
        const double overlap = wall_overlap(g, contact.wall, walls.box);
        ForceSum& sum = force[contact.record];
        sum.fx += on_grain.x();
        sum.fy += on_grain.y();
        if constexpr (features & has_friction) {
            sum.shear += answer.shear;
            sum.lost_torque += 0.5 * answer.shear * overlap - answer.moment;
        }
        sums.force[contact.wall] -= on_grain;
        sums.friction_loss += answer.friction_loss;
        sums.damping_loss += answer.damping_loss;
        sums.overlap = std::max(sums.overlap, overlap);
    }
    return sums;
}

constexpr unsigned rolling = has_friction | has_rolling;

struct Row {
    bool hertz;
    unsigned features;
    WallKernel kernel;
};

constexpr Row table[]{
    {false, no_part, press<Linear, no_part>},
    {false, has_damping, press<Linear, has_damping>},
    {false, has_friction, press<Linear, has_friction>},
    {false, has_friction | has_damping, press<Linear, has_friction | has_damping>},
    {false, rolling, press<Linear, rolling>},
    {false, rolling | has_damping, press<Linear, rolling | has_damping>},
    {true, no_part, press<Hertz, no_part>},
    {true, has_damping, press<Hertz, has_damping>},
    {true, has_friction, press<Hertz, has_friction>},
    {true, has_friction | has_damping, press<Hertz, has_friction | has_damping>},
    {true, rolling, press<Hertz, rolling>},
    {true, rolling | has_damping, press<Hertz, rolling | has_damping>},
};

}  // namespace

double wall_overlap(const GrainRecord& grain, int wall, const Box& box) {
    return grain.radius - box.distance(wall, {grain.x, grain.y});
}

ContactForce wall_force(WallContact& contact, const GrainRecord& grain, const WallMotion& walls,
                        const Parameters& law, double dt) {
    constexpr unsigned all = rolling | has_damping;
    return (law.hertz ? force_at_wall<Hertz, all> : force_at_wall<Linear, all>)(contact, grain, walls,
                                                                                law.at_walls, dt);
}

WallKernel wall_kernel(bool hertz, unsigned features) {
    for (const Row& row : table)
        if (row.hertz == hertz && row.features == features) return row.kernel;
    throw std::logic_error("no kernel for this combination of contact laws at walls");
}

}  // namespace softgrain::rigid_dem
