#pragma once
// What a scenario may ask for and a method may not have: refused in one clear line, never ignored.
#include <string_view>

#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

enum class Feature {
    periodic_cell,
    grain_classes,  ///< more than one
    ellipses,
    friction,
    wall_friction,
    cohesion,
    yield_stress,
};

/// Throws InputError, "box.periodic = true is not for bpm: WHY; set ... or run another method", if the
/// scenario or its packing asks for the feature.
void refuse(const Scenario& scenario, const Packing& packing, std::string_view method, Feature feature,
            std::string_view why);

}  // namespace softgrain
