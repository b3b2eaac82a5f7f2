#pragma once
// The inner loops of contact dynamics: rows [first, last), one after the other.
#include "common/box.hpp"
#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/discs.hpp"

namespace softgrain::contact_sweep {

/// What resists motion along a contact.
struct Resistance {
    double friction = 0.0;  ///< Coulomb coefficient
    double rolling = 0.0;   ///< largest torque / (normal force (r_i + r_j)), Estrada et al. 2008
};

/// Normals and gap speeds at the start of a step of length h; overlaps count as largest_push at most. Returns
/// the deepest overlap [m], 0 if none.
double set_geometry(ContactRows& rows, const Discs& discs, double h, double largest_push, int first,
                    int last);
double set_geometry(WallRows& rows, const Discs& discs, const Box& box, double h, double largest_push,
                    int first, int last);

/// Applies the stored impulses to the velocities.
void warm_start(const ContactRows& rows, const Discs& discs, const Resistance& resistance, int first,
                int last);
void warm_start(const WallRows& rows, const Discs& discs, int first, int last);

/// One relaxation sweep. Each returns the largest |dp / (omega m_e)| [m/s]. omega is for the normal impulses
/// of rows without friction; friction and rolling are relaxed with 1.
double relax(ContactRows& rows, const Discs& discs, const Resistance& resistance, double omega, int first,
             int last);
double relax_block(ContactRows& rows, const Discs& discs, const Resistance& resistance, double omega,
                   int block);
double relax(WallRows& rows, const Discs& discs, const WallMotion& walls, double omega, int first, int last);

}  // namespace softgrain::contact_sweep
