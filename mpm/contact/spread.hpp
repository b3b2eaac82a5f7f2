#pragma once
// How what acts at a contact acts on nodes.
#include <span>

#include "mpm/contact/contacts.hpp"
#include "mpm/disc/quadratic_spline.hpp"

namespace softgrain::mpm {

/// Adds the derivative of an energy by the position of the point, and its negative by that of the place on j,
/// to those by nodes. `force` [all nodes].
inline void spread_on_contact(const Grains& grains, const PointContact& c, const Vec2& by,
                              std::span<Vec2> force) {
    const ReferenceDisc& disc = *grains.disc;
    const auto add = [&](const ShapeRows& rows, int row, int grain, const Vec2& what) {
        const auto r = static_cast<std::size_t>(row),
                   first = static_cast<std::size_t>(grain) * grains.nodes();
        for (std::size_t k = 0; k < rows.nodes(r).size(); ++k)
            force[first + static_cast<std::size_t>(rows.nodes(r)[k])] += rows.values(r)[k] * what;
    };
    add(disc.surface, c.point, c.i, by);
    if (c.j < 0) return;
    const SplineSpan s = spline_span(c.place.t);
    const int controls = static_cast<int>(disc.control.size());
    for (int k = 0; k < 3; ++k)
        add(disc.control, (c.place.span + k) % controls, c.j, -s.value[static_cast<std::size_t>(k)] * by);
}

}  // namespace softgrain::mpm
