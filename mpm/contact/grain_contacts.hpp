#pragma once
// Contact points summed by pairs of grains, as every method shows them.
#include <vector>

#include "common/grain_view.hpp"
#include "mpm/contact/contacts.hpp"
#include "mpm/contact/friction.hpp"

namespace softgrain::mpm {

/// sliders [points] as in Friction, or empty. Pairs that carry force, sorted by (i, j), walls first. The
/// length is that of the surfaces in touch, mean of both grains.
std::vector<GrainContact> sum_grain_contacts(const Grains& grains, const Surfaces& surfaces,
                                             const Contacts& contacts, std::span<const Slider> sliders = {});

/// Area of all overlaps, of grains and of grains with walls [m^2].
double overlap_area(const Surfaces& surfaces, const Contacts& contacts, const Grains& grains);

/// [m], 0 if nothing touches.
double deepest_overlap(const Contacts& contacts);

}  // namespace softgrain::mpm
