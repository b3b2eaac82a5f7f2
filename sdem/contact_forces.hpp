#pragma once
// Forces of one contact, and their sum over one grain.
#include <numbers>

#include "common/vec.hpp"
#include "sdem/geometry/chord.hpp"
#include "sdem/geometry/wall_chord.hpp"
#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {

/// One grain's side of a contact.
struct Side {
    Vec2 arm;    ///< X = F^-1 (point - c) [m], in the reference disc
    double cap;  ///< S [m^2]
    double psi;  ///< half opening angle of the cap
};

/// A pair of the neighbour list.
struct PairContact {
    Overlap overlap = Overlap::none;
    NormalForce force;
    Vec2 normal;    ///< unit, out of i
    Vec2 point;     ///< mid-point of the chord [m]
    double length;  ///< L_c [m]
    Side i, j;

    bool touching() const { return overlap == Overlap::chord || overlap == Overlap::four_points; }
};

/// A grain at a wall.
struct WallContact {
    NormalForce force;
    Vec2 point;     ///< [m]
    double length;  ///< L_c [m]
    Side grain;
};

/// Sums over a grain's contacts.
struct GrainForces {
    Vec2 force;           ///< sum f [N]
    Mat2 moment;          ///< sum f (x) X - A0 P, shape damping included [N m]
    Vec2 damping_force;   ///< part of `force` due to damping
    Mat2 damping_moment;  ///< part of `moment` due to damping
    double caps;          ///< sum S [m^2]
    double covered;       ///< sum psi / pi: share of the outline that contacts cover
};

/// A grain as its contacts see it.
struct Moving {
    const Ellipse& shape;
    const Vec2& velocity;
    const Mat2& F_rate;
    double mass;
};

/// X = F^-1 r = R A^-1 r.
inline Vec2 reference_arm(const Ellipse& e, const Vec2& point) {
    return e.radius * (e.inverse * (point - e.center));
}

inline PairContact pair_contact(const Moving& i, const Moving& j, const Mollon2022& law, WarmStart& warm) {
    PairContact c;
    const Chord chord = chord_of(i.shape, j.shape, warm);
    c.overlap = chord.overlap;
    if (!chord.touching()) return c;
    c.normal = chord.normal;
    c.point = chord.point;
    c.length = chord.length;
    c.i = {reference_arm(i.shape, chord.point), chord.cap_i, chord.psi_i};
    c.j = {reference_arm(j.shape, chord.point), chord.cap_j, chord.psi_j};
    // Material points at the chord's mid-point; delta_n is minus half of the overlap (Eq. 54).
    const Vec2 separation_rate = j.velocity + j.F_rate * c.j.arm - i.velocity - i.F_rate * c.i.arm;
    const double delta_n = -0.5 * (chord.depth_i + chord.depth_j);
    const double delta_rate = 0.5 * c.normal.dot(separation_rate);
    c.force = law.normal_force(c.length, delta_n, delta_rate, i.mass * j.mass / (i.mass + j.mass));
    return c;
}

inline WallContact wall_contact(const Moving& g, const WallChord& chord, const Vec2& inward,
                                const Vec2& wall_velocity, const Mollon2022& law) {
    WallContact c;
    c.point = chord.point;
    c.length = chord.length;
    c.grain = {reference_arm(g.shape, chord.point), chord.cap, chord.psi};
    // At a wall delta_n is the full depth.
    const double delta_rate = inward.dot(g.velocity + g.F_rate * c.grain.arm - wall_velocity);
    c.force = law.normal_force(c.length, -chord.depth, delta_rate, g.mass);
    return c;
}

/// Adds one contact: `push` unit vector along which N acts on the grain.
inline void add_contact(GrainForces& sum, const NormalForce& N, const Vec2& push, const Side& side) {
    const Vec2 f = N.total * push;
    const Vec2 damping = N.damping * push;
    sum.force += f;
    sum.damping_force += damping;
    sum.moment.noalias() += f * side.arm.transpose();
    sum.damping_moment.noalias() += damping * side.arm.transpose();
    sum.caps += side.cap;
    sum.covered += std::numbers::inv_pi * side.psi;
}

}  // namespace softgrain::sdem
