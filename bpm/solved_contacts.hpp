#pragma once
// The contacts of a step, whichever engine solved them.
#include <span>

#include "common/contact_dynamics/contact_rows.hpp"

namespace softgrain::bpm {

/// Impulses are `normal` and `tangential` of a row times its reduced mass.
struct SolvedContacts {
    const ContactRows& rows;
    const WallRows& wall_rows;

    /// Of a row between discs [kg].
    double reduced_mass(std::size_t row, std::span<const double> mass) const {
        return rows.share[row] * mass[static_cast<std::size_t>(rows.i[row])];
    }
};

}  // namespace softgrain::bpm
