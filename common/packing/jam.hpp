#pragma once
// Frictionless discs between four walls or in a periodic cell, compressed to the point where they jam.
#include <vector>

#include "common/neighbors.hpp"
#include "common/packing/packing.hpp"
#include "common/packing/packing_request.hpp"
#include "common/packing/random.hpp"

namespace softgrain {

/// The discs that frictionless contacts can hold.
struct CarryingDiscs {
    double coordination_number = 0.0;  ///< 2 N_gg / N, without rattlers
    int contacts = 0;                  ///< with grains and walls, without those of rattlers
    int rattlers = 0;                  ///< discs with fewer than 3 contacts, removed repeatedly
};
/// `contacts` as OverlapEnergy::contacts, of n discs.
CarryingDiscs carrying_discs(const std::vector<Pair>& contacts, std::size_t n);

struct JammedPacking : CarryingDiscs {
    Packing packing;                ///< no overlaps; box [0, width] x [0, height]
    double packing_fraction = 0.0;  ///< of the discs
};

/// Largest overlap [mean radius] of the jammed discs before the box is opened until they only touch.
inline constexpr double jamming_tolerance = 5e-7;

/// Places the discs at random, compresses them to rest in small steps, then closes in on the jamming point.
/// With `packing_fraction` it stops there, below jamming. The result has no overlaps; without
/// `packing_fraction` it is below jamming by not more than a linear strain of jamming_tolerance mean radius /
/// smallest radius. Throws InputError if it jams before `packing_fraction`, or if a periodic cell is too
/// small for these discs.
/// The box and the centres shrink together: the same as radii that grow in a box that stays.
JammedPacking jam(const std::vector<double>& radii, const PackingRequest& request, Random& random);

/// The same from the outside: the walls move in on a loose random packing without overlap, past discs that
/// only they and other discs push. Not for a periodic cell. Throws InputError as well if the box is too
/// narrow for the loose packing.
JammedPacking compact(const std::vector<double>& radii, const PackingRequest& request, Random& random);

}  // namespace softgrain
