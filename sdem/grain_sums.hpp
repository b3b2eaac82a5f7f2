#pragma once
// What a grain feels: the sum over its contacts, in the order of the contact list.
#include <numbers>
#include <span>

#include "sdem/contact_list.hpp"

namespace softgrain::sdem {

/// Sums over one grain's contacts. r: from its centre to the mid-point of the chord.
struct GrainSums {
    double fx = 0.0, fy = 0.0;                  ///< sum f [N]
    Tensor moment{0.0, 0.0, 0.0, 0.0};          ///< sum f (x) r [N m]
    double pressed = 0.0;                       ///< sum q S [N m]
    double damping_fx = 0.0, damping_fy = 0.0;  ///< part of f due to dashpots
    Tensor damping_moment{0.0, 0.0, 0.0, 0.0};
    double caps = 0.0;     ///< sum S [m^2]
    double covered = 0.0;  ///< sum psi / pi: share of the outline that contacts cover
};

/// One grain's side of a touching contact.
struct Side {
    int other;          ///< the other grain, or -1 - wall
    bool second;        ///< this grain is the contact's j
    double tangential;  ///< force on j along the turned chord, per chord length [N/m]

    double sign() const { return second ? 1.0 : -1.0; }
    double share(const Contact& c) const { return second ? 1.0 - c.share_i : c.share_i; }
    Vec2 arm(const Contact& c) const { return second ? Vec2{c.arm_jx, c.arm_jy} : Vec2{c.arm_ix, c.arm_iy}; }
    double cap(const Contact& c) const { return second ? c.cap_j : c.cap_i; }
    double psi(const Contact& c) const { return static_cast<double>(second ? c.psi_j : c.psi_i); }
};

/// How a contact's forces are put together.
struct ForceSource {
    const ContactList& contacts;
    /// [n] p G' of each grain: its pressure on a contact's share of the overlap [N/m]; empty if the law has
    /// none.
    std::span<const double> push;
    bool sliding;  ///< tangential forces are to be added

    /// Elastic and damping force per chord length [N/m].
    double elastic(const Contact& c, std::size_t i, std::size_t j) const {
        return push.empty() ? c.q : c.q + c.share_i * push[i] + (1.0 - c.share_i) * push[j];
    }
    double elastic_at_wall(const Contact& c, std::size_t g) const {
        return push.empty() ? c.q : c.q + push[g];
    }
    double elastic(const Contact& c, const Side& side, std::size_t g) const {
        if (side.other < 0) return elastic_at_wall(c, g);
        const auto other = static_cast<std::size_t>(side.other);
        return side.second ? elastic(c, other, g) : elastic(c, g, other);
    }
};

/// Adds one side of a contact with the elastic force q per chord length.
inline void add_side(GrainSums& s, const Contact& c, const Side& side, double q) {
    const double sign = side.sign(), cap = side.cap(c);
    const double x = side.second ? c.arm_jx : c.arm_ix, y = side.second ? c.arm_jy : c.arm_iy;
    const double dashpot = damping_without_pull(q, c.q_damping);
    const double normal = sign * (q + dashpot), along = sign * side.tangential, damping = sign * dashpot;
    const double fx = normal * c.chord_x - along * c.chord_y, fy = normal * c.chord_y + along * c.chord_x;
    const double dx = damping * c.chord_x, dy = damping * c.chord_y;
    s.fx += fx;
    s.fy += fy;
    s.moment.xx += fx * x;
    s.moment.xy += fx * y;
    s.moment.yx += fy * x;
    s.moment.yy += fy * y;
    s.pressed += q * cap;
    s.damping_fx += dx;
    s.damping_fy += dy;
    s.damping_moment.xx += dx * x;
    s.damping_moment.xy += dx * y;
    s.damping_moment.yx += dy * x;
    s.damping_moment.yy += dy * y;
    s.caps += cap;
    s.covered += side.psi(c);
}

/// visit(contact, side) for all that grain g touches: walls, pairs in which it comes first, the other pairs.
template <class Visit>
inline void each_contact_of(const ContactList& list, std::size_t g, bool sliding, const Visit& visit) {
    for (std::size_t w = list.wall_first(g); w < list.wall_first(g + 1); ++w)
        if (list.wall_contact[w].touching())
            visit(list.wall_contact[w], Side{-1 - list.wall_pairs()[w].wall, false,
                                             sliding ? list.wall_history.tangential[w] : 0.0});
    for (std::size_t k = list.first(g); k < list.first(g + 1); ++k)
        if (list.pair_contact[k].touching())
            visit(list.pair_contact[k],
                  Side{list.pairs()[k].j, false, sliding ? list.pair_history.tangential[k] : 0.0});
    for (const std::uint32_t k : list.second(g))
        if (list.pair_contact[k].touching())
            visit(list.pair_contact[k],
                  Side{list.pairs()[k].i, true, sliding ? list.pair_history.tangential[k] : 0.0});
}

/// Sums of grain g, in the order of each_contact_of.
inline GrainSums sum_contacts(const ForceSource& from, std::size_t g) {
    GrainSums s;
    each_contact_of(from.contacts, g, from.sliding, [&](const Contact& c, const Side& side) {
        add_side(s, c, side, from.elastic(c, side, g));
    });
    s.covered *= std::numbers::inv_pi;
    return s;
}

/// T = sum of the overlaps that grain g gives way to / its reference area.
inline double given_way(const ContactList& list, const Grain& grain, std::size_t g) {
    double sum = 0.0;
    each_contact_of(list, g, false,
                    [&](const Contact& c, const Side& side) { sum += side.share(c) * (c.cap_i + c.cap_j); });
    return sum / grain.reference_area();
}

}  // namespace softgrain::sdem
