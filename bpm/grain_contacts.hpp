#pragma once
// Contacts between discs of different grains, summed to contacts between grains.
#include <span>
#include <vector>

#include "bpm/solved_contacts.hpp"
#include "common/box.hpp"
#include "common/contact_dynamics/discs.hpp"
#include "common/grain_view.hpp"

namespace softgrain::bpm {

/// Contacts and stress of the grains after a step.
struct GrainContacts {
    std::vector<GrainContact> contacts;  ///< sorted by (i, j)
    std::vector<Mat2> stress;            ///< [grains] compression positive [N/m]
};

struct GrainContactInput {
    Discs discs;  ///< positions after the step; group = grain
    std::span<const Vec2> centroid;
    std::span<const double> area;  ///< [grains] that the stress is averaged over [m^2]
    Box box;
    double touch_gap;  ///< largest gap of two discs in contact [m]
    double step;       ///< h of the impulses [s]
};

/// Two grains touch if the gap of any two of their discs is below touch_gap, or if they exchanged an impulse
/// in the last step. The force is the sum of the impulses / h, the point their weighted mean, the length the
/// extent of the touching discs along the contact. Stress: Love-Weber sum over these outer contacts.
GrainContacts sum_grain_contacts(const SolvedContacts& solved, const GrainContactInput& input);

}  // namespace softgrain::bpm
