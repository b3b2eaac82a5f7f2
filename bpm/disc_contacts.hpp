#pragma once
// Contacts between discs, within a grain and between grains, one by one.
#include <vector>

#include "bpm/grain_contacts.hpp"

namespace softgrain::bpm {

struct DiscContacts {
    std::vector<PartContact> contacts;  ///< sorted by (i, j), walls first
    std::vector<double> touching;       ///< [discs] discs and walls that it touches
    std::vector<double> force;          ///< [discs] sum of the sizes of its normal forces [N]
};

/// A contact is a pair that exchanged an impulse in the last step; discs also touch if their gap is below
/// touch_gap.
DiscContacts list_disc_contacts(const SolvedContacts& solved, const GrainContactInput& input);

}  // namespace softgrain::bpm
