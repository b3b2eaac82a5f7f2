#pragma once
// One number for all that is seen of the grains at a sample: two runs of the same bits have the same ones.
#include <cstdint>

#include "common/grain_view.hpp"

namespace softgrain {

/// What state_hash reads.
inline constexpr Need hashed = Need::area | Need::contacts | Need::stress;

/// Of time, box, wall forces, energies, and of each grain its centroid, velocity, area and stress, and of
/// each contact its grains, place, length and force. Any changed bit of them changes it (but for chance, 1 in
/// 2^64). Deformation is in it by the grains' areas and the lengths and places of their contacts.
std::uint64_t state_hash(const GrainView& view);

}  // namespace softgrain
