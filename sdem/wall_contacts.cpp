#include "sdem/wall_contacts.hpp"

#include "sdem/geometry/wall_chord.hpp"
#include "sdem/laws/lens_potential.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {
namespace {

/// X' of the material point at `arm` from the centre: F' F^-1 arm.
Vec2 velocity_at(const Grain& g, const Vec2& arm) {
    const double to_reference = 1.0 / g.F.det();
    const double X = to_reference * (g.F.yy * arm.x() - g.F.xy * arm.y());
    const double Y = to_reference * (g.F.xx * arm.y() - g.F.yx * arm.x());
    return {g.vx + g.F_rate.xx * X + g.F_rate.xy * Y, g.vy + g.F_rate.yx * X + g.F_rate.yy * Y};
}

}  // namespace

WallNews evaluate_walls(const WallInput& in, ContactList& list, std::size_t begin, std::size_t end) {
    WallNews news;
    for (std::size_t k = begin; k < end; ++k) {
        const WallPair pair = list.wall_pairs()[k];
        const auto g = static_cast<std::size_t>(pair.grain);
        const Grain& grain = in.grains.grain[g];
        const GrainMaterial& material = in.grains.material_of(g);
        Contact& c = list.wall_contact[k];
        const bool touched = c.touching();
        c = Contact{};
        list.wall_opening[k] = Opening{};
        const double distance = in.motion.box.distance(pair.wall, in.grains.center[g]);
        if (distance >= in.grains.reach[g]) continue;
        const Vec2 inward = wall_normal(pair.wall);
        const WallChord chord = wall_chord(ellipse_of(grain), inward, distance);
        if (!chord.touching) continue;
        const Vec2 arm = chord.point - in.grains.center[g];
        const Vec2 against_wall = velocity_at(grain, arm) - in.motion.velocity_of(pair.wall);
        const ContactInput input{chord.length, chord.depth, -inward.dot(against_wall), material.E,
                                 grain.mass};
        const ContactAnswer answer = in.law == ContactLaw::lens_potential
                                         ? LensPotential::contact(input, in.contact_damping)
                                         : Mollon2022::contact(input, in.contact_damping);
        c.chord_x = -chord.length * inward.x();
        c.chord_y = -chord.length * inward.y();
        c.arm_x = arm.x();
        c.arm_y = arm.y();
        c.cap_i = chord.cap;
        c.q = answer.q;
        c.q_damping = answer.q_damping;
        list.wall_opening[k].psi_i = static_cast<float>(chord.psi);
        // Of the wall against the grain, along the turned outward normal.
        if (!list.wall_history.slip_rate.empty())
            list.wall_history.slip_rate[k] = cross(inward, against_wall);
        if ((chord.escaped || !(answer.stiffness > 0.0)) && k < news.bad) news.bad = k;
        if (!touched) news.closed.push_back(k);
    }
    return news;
}

}  // namespace softgrain::sdem
