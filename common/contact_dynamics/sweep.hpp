#pragma once
// The inner loops of contact dynamics. A range [first, last) of one colour may be split between threads.
#include "common/box.hpp"
#include "common/contact_dynamics/contact_rows.hpp"
#include "common/contact_dynamics/discs.hpp"

namespace softgrain::contact_sweep {

/// Normals and gap speeds at the start of a step of length h; overlaps count as largest_push at most.
void set_geometry(ContactRows& rows, const Discs& discs, double h, double largest_push, int first, int last);
void set_geometry(WallRows& rows, const Discs& discs, const Box& box, double h, double largest_push,
                  int first, int last);

/// Applies the stored impulses to the velocities.
void warm_start(const ContactRows& rows, const Discs& discs, int first, int last);
void warm_start_with_friction(const ContactRows& rows, const Discs& discs, int first, int last);
void warm_start(const WallRows& rows, const Discs& discs, int first, int last);

/// One relaxation sweep. Each returns the largest |dp / (omega m_e)| [m/s].
double relax(ContactRows& rows, const Discs& discs, double omega, int first, int last);
double relax_with_friction(ContactRows& rows, const Discs& discs, double friction, int first, int last);
double relax(WallRows& rows, const Discs& discs, const WallMotion& walls, double omega, int first, int last);

}  // namespace softgrain::contact_sweep
