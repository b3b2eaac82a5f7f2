#pragma once
// What a scenario may ask for and a method may not have: refused in one clear line, never ignored.
#include <optional>
#include <span>
#include <string_view>

#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

enum class Feature {
    periodic_cell,
    grain_classes,  ///< more than one
    ellipses,
    clumps,  ///< rigid clusters of discs
    friction,
    wall_friction,
    cohesion,
    yield_stress,
    driven_grains,
};

/// A feature that a method does not have, and why, for the message.
struct Refusal {
    Feature feature;
    std::string_view why;
};

/// Throws InputError, "box.periodic = true is not for bpm: WHY; set ... or run another method", if the
/// scenario or its packing asks for one of the features.
void refuse(const Scenario& scenario, const Packing& packing, std::string_view method,
            std::span<const Refusal> refusals);

/// A row of the table of features: loading, boundaries and grains, as `softgrain list` shows them.
struct FeatureRow {
    std::string_view title;
    std::optional<Feature> needs;  ///< none: every method has it, because it lies outside of them
};
std::span<const FeatureRow> feature_rows();
bool has_feature(std::span<const Refusal> refusals, const FeatureRow& row);

}  // namespace softgrain
