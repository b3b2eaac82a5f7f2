#include "common/refusals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "common/errors.hpp"

namespace softgrain {
namespace {

/// What in the scenario asks for a feature, and what to write instead.
struct Asked {
    std::string what, cure;
};

std::optional<Asked> material_key(std::string_view key, double value) {
    if (value == 0.0) return std::nullopt;
    return Asked{fmt::format("material.{} = {}", key, value), fmt::format("set material.{} = 0", key)};
}

std::optional<Asked> yield_stress(const Scenario& scenario) {
    for (std::size_t c = 0; c < scenario.class_count(); ++c) {
        const auto& yield = scenario.material_of(c).yield_stress;
        if (!yield) continue;
        const std::string table = scenario.classes.empty() || scenario.material.yield_stress
                                      ? std::string("material")
                                      : fmt::format("grain_class.{}", c);
        return Asked{fmt::format("{}.yield_stress = {}", table, *yield), "leave it out"};
    }
    return std::nullopt;
}

std::optional<Asked> asked_for(const Scenario& scenario, const Packing& packing, Feature feature) {
    const Material& material = scenario.material;
    switch (feature) {
        case Feature::periodic_cell:
            if (packing.box.periodic) return Asked{"box.periodic = true", "set box.periodic = false"};
            break;
        case Feature::grain_classes:
            if (scenario.class_count() > 1)
                return Asked{fmt::format("a scenario of {} grain classes", scenario.class_count()),
                             "keep one [[grain_class]]"};
            break;
        case Feature::ellipses:
            if (std::any_of(packing.aspect_ratio.begin(), packing.aspect_ratio.end(),
                            [](double ratio) { return ratio != 1.0; }))
                return Asked{"a packing of ellipses", "set grain_class.aspect_ratio = 1"};
            break;
        case Feature::clumps:
            if (!packing.clumps.empty())
                return Asked{"a packing of clumps", "leave out grain_class.clump and clump_discs"};
            break;
        case Feature::friction:
            return material_key("friction", material.friction);
        case Feature::wall_friction:
            return material_key("wall_friction", material.wall_friction);
        case Feature::cohesion:
            return material_key("cohesion", material.cohesion);
        case Feature::yield_stress:
            return yield_stress(scenario);
        case Feature::driven_grains:
            if (!packing.driven.empty()) return Asked{"[[driven]]", "leave it out"};
            break;
    }
    return std::nullopt;
}

constexpr std::array rows{
    FeatureRow{"walls by displacement", std::nullopt},
    FeatureRow{"walls by stress (servo-control)", std::nullopt},
    FeatureRow{"periodic cell by strain or velocity gradient", Feature::periodic_cell},
    FeatureRow{"periodic cell by stress (servo-control)", Feature::periodic_cell},
    FeatureRow{"simple shear, at constant area or normal stress", Feature::periodic_cell},
    FeatureRow{"stress and strain probes, cycles", std::nullopt},
    FeatureRow{"several grain classes", Feature::grain_classes},
    FeatureRow{"ellipses", Feature::ellipses},
    FeatureRow{"rigid clusters of discs (clumps)", Feature::clumps},
    FeatureRow{"friction between grains", Feature::friction},
    FeatureRow{"friction at walls", Feature::wall_friction},
    FeatureRow{"cohesion", Feature::cohesion},
    FeatureRow{"yield stress of the material", Feature::yield_stress},
    FeatureRow{"gravity (walls only)", std::nullopt},
    FeatureRow{"driven grains", Feature::driven_grains},
};

}  // namespace

void refuse(const Scenario& scenario, const Packing& packing, std::string_view method,
            std::span<const Refusal> refusals) {
    for (const auto& [feature, why] : refusals)
        if (const auto asked = asked_for(scenario, packing, feature))
            throw InputError(fmt::format("{} is not for {}: {}; {} or run another method", asked->what,
                                         method, why, asked->cure));
}

std::span<const FeatureRow> feature_rows() {
    return rows;
}

bool has_feature(std::span<const Refusal> refusals, const FeatureRow& row) {
    return std::none_of(refusals.begin(), refusals.end(),
                        [&](const Refusal& refusal) { return row.needs == refusal.feature; });
}

}  // namespace softgrain
