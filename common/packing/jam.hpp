#pragma once
// Frictionless discs between four walls, compressed to the point where they jam.
#include <optional>
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/random.hpp"

namespace softgrain {

struct JammedPacking {
    Packing packing;                   ///< no overlaps; box [0, width] x [0, height]
    double packing_fraction = 0.0;     ///< of `packing`
    double coordination_number = 0.0;  ///< 2 N_gg / N, without rattlers
    int contacts = 0;                  ///< with grains and walls, without those of rattlers
    int rattlers = 0;                  ///< discs with fewer than 3 contacts, removed repeatedly
};

/// Largest overlap [mean radius] of the jammed discs before the box is opened until they only touch.
inline constexpr double jamming_tolerance = 5e-7;

/// Places the discs at random, compresses them to rest in small steps, then closes in on the jamming point of
/// a box with this height / width. With `packing_fraction` it stops there, below jamming. The result has no
/// overlaps; without `packing_fraction` it is below jamming by not more than a linear strain of
/// jamming_tolerance mean radius / smallest radius. Throws InputError if it jams before `packing_fraction`.
JammedPacking jam(const std::vector<double>& radii, double aspect_ratio, Random& random,
                  std::optional<double> packing_fraction = std::nullopt);

}  // namespace softgrain
