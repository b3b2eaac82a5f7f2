#pragma once
// What a grain feels: the sum over its contacts, in the order of the contact list.
#include <numbers>
#include <span>

#include "sdem/contact_list.hpp"

namespace softgrain::sdem {

/// One grain's side of a touching contact.
struct Side {
    const Contact& contact;
    std::size_t index;    ///< of the pair, or of the wall pair
    int other;            ///< the other grain, or -1 - wall
    bool second;          ///< this grain is the contact's j
    double share;         ///< of the overlap that this grain gives way to
    double arm_x, arm_y;  ///< from this grain's centre to the mid-point of the chord [m]

    bool wall() const { return other < 0; }
    double sign() const { return second ? 1.0 : -1.0; }
    double cap() const { return second ? contact.cap_j : contact.cap_i; }
    double gives_way() const { return share * contact.lens(); }  ///< [m^2]
};

/// All contacts, as the grains see them.
struct ContactView {
    const ContactList& list;
    std::span<const Vec2> center;  ///< [n] [m]
    const Box& cell;               ///< whose images the list means

    /// visit(side) for all that grain g touches: walls, pairs in which it comes first, the other pairs.
    template <class Visit>
    void each_side_of(std::size_t g, const Visit& visit) const {
        for (std::size_t w = list.wall_first(g); w < list.wall_first(g + 1); ++w) {
            const Contact& c = list.wall_contact[w];
            if (c.touching()) visit(Side{c, w, -1 - list.wall_pairs()[w].wall, false, 1.0, c.arm_x, c.arm_y});
        }
        for (std::size_t k = list.first(g); k < list.first(g + 1); ++k) {
            const Contact& c = list.pair_contact[k];
            if (c.touching()) visit(Side{c, k, list.pairs()[k].j, false, list.share[k], c.arm_x, c.arm_y});
        }
        for (const std::uint32_t k : list.second(g)) {
            const Contact& c = list.pair_contact[k];
            if (!c.touching()) continue;
            const int i = list.pairs()[k].i;
            Vec2 branch = center[g] - center[static_cast<std::size_t>(i)];
            if (!list.images().empty()) branch += cell.image(list.images()[k]);
            visit(Side{c, k, i, true, 1.0 - list.share[k], c.arm_x - branch.x(), c.arm_y - branch.y()});
        }
    }
};

/// How a contact's forces are put together.
struct ForceSource {
    ContactView contacts;
    bool sliding;  ///< tangential forces are to be added

    /// Force on j along the turned chord, per chord length [N/m].
    double tangential(const Side& side) const {
        if (!sliding) return 0.0;
        const ContactHistory& history = side.wall() ? contacts.list.wall_history : contacts.list.pair_history;
        return history.tangential[side.index];
    }
};

/// Sums over one grain's contacts. r: from its centre to the mid-point of the chord.
struct GrainSums {
    double fx = 0.0, fy = 0.0;                  ///< sum f [N]
    Tensor moment{0.0, 0.0, 0.0, 0.0};          ///< sum f (x) r [N m]
    double pressed = 0.0;                       ///< sum q S [N m]
    double damping_fx = 0.0, damping_fy = 0.0;  ///< part of f due to dashpots
    Tensor damping_moment{0.0, 0.0, 0.0, 0.0};
    double caps = 0.0;  ///< sum S [m^2]
};

template <bool sliding>
GrainSums sum_sides(const ForceSource& from, std::size_t g) {
    GrainSums s;
    from.contacts.each_side_of(g, [&](const Side& side) {
        const Contact& c = side.contact;
        const double q = c.q, dashpot = damping_without_pull(q, c.q_damping);
        const double normal = side.sign() * (q + dashpot), damping = side.sign() * dashpot;
        double fx = normal * c.chord_x, fy = normal * c.chord_y;
        if constexpr (sliding) {
            const double along = side.sign() * from.tangential(side);
            fx -= along * c.chord_y;
            fy += along * c.chord_x;
        }
        const double dx = damping * c.chord_x, dy = damping * c.chord_y;
        s.fx += fx;
        s.fy += fy;
        s.moment.xx += fx * side.arm_x;
        s.moment.xy += fx * side.arm_y;
        s.moment.yx += fy * side.arm_x;
        s.moment.yy += fy * side.arm_y;
        s.pressed += q * side.cap();
        s.damping_fx += dx;
        s.damping_fy += dy;
        s.damping_moment.xx += dx * side.arm_x;
        s.damping_moment.xy += dx * side.arm_y;
        s.damping_moment.yx += dy * side.arm_x;
        s.damping_moment.yy += dy * side.arm_y;
        s.caps += side.cap();
    });
    return s;
}

/// Sums of grain g, in the order of each_side_of.
inline GrainSums sum_contacts(const ForceSource& from, std::size_t g) {
    return from.sliding ? sum_sides<true>(from, g) : sum_sides<false>(from, g);
}

/// sum psi / pi: share of grain g's outline that contacts cover, for laws that use it.
inline double covered_outline(const ContactList& list, std::size_t g) {
    double sum = 0.0;
    for (std::size_t w = list.wall_first(g); w < list.wall_first(g + 1); ++w)
        sum += static_cast<double>(list.wall_opening[w].psi_i);
    for (std::size_t k = list.first(g); k < list.first(g + 1); ++k)
        sum += static_cast<double>(list.pair_opening[k].psi_i);
    for (const std::uint32_t k : list.second(g)) sum += static_cast<double>(list.pair_opening[k].psi_j);
    return std::numbers::inv_pi * sum;
}

}  // namespace softgrain::sdem
