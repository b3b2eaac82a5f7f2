#pragma once
// The generators by their names, and what a scenario cannot ask of them.
#include <array>
#include <string_view>
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/packing_request.hpp"
#include "common/packing/random.hpp"
#include "common/scenario.hpp"
#include "common/settings.hpp"

namespace softgrain {

/// In the order of the enumeration.
inline constexpr std::array<std::string_view, 5> generator_names{"growth", "random_sequential", "compaction",
                                                                 "geometric", "deposition"};

/// Contradictions between the key packing.generator and packing.packing_fraction or box.periodic, each for
/// the key (of [packing]) at which it is to be reported.
std::vector<KeyFault> generator_faults(Generator generator, bool has_packing_fraction, bool periodic);

/// Discs of exactly these radii, in their order, in a box [0, width] x [0, height]. Throws InputError for a
/// fault, and as the generator does.
Packing generate(Generator generator, const std::vector<double>& radii, const PackingRequest& request,
                 Random& random);

}  // namespace softgrain
