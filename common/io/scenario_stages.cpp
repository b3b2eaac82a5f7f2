#include "common/io/scenario_stages.hpp"

#include "common/io/scenario_schema.hpp"

namespace softgrain::scenario_io {
namespace {

/// Numbers that may be left out, by key.
struct OptionalKey {
    std::string_view key;
    std::optional<double> LoadingStage::*member;
};
constexpr std::array optional_keys{
    OptionalKey{"lateral_stress", &LoadingStage::lateral_stress},
    OptionalKey{"normal_stress", &LoadingStage::normal_stress},
    OptionalKey{"stress_xx", &LoadingStage::stress_xx},
    OptionalKey{"stress_yy", &LoadingStage::stress_yy},
    OptionalKey{"stress_amplitude", &LoadingStage::stress_amplitude},
    OptionalKey{"strain_amplitude", &LoadingStage::strain_amplitude},
    OptionalKey{"until_strain", &LoadingStage::until_strain},
    OptionalKey{"until_packing_fraction", &LoadingStage::until_packing_fraction},
    OptionalKey{"until_packing_fraction_undeformed", &LoadingStage::until_packing_fraction_undeformed},
    OptionalKey{"until_shear", &LoadingStage::until_shear},
    OptionalKey{"until_stress", &LoadingStage::until_stress},
    OptionalKey{"until_stress_xx", &LoadingStage::until_stress_xx},
    OptionalKey{"until_stress_yy", &LoadingStage::until_stress_yy},
    OptionalKey{"until_stress_ratio", &LoadingStage::until_stress_ratio},
    OptionalKey{"until_unbalanced", &LoadingStage::until_unbalanced},
    OptionalKey{"duration", &LoadingStage::duration},
    OptionalKey{"strain_rate", &LoadingStage::strain_rate},
    OptionalKey{"inertial_number", &LoadingStage::inertial_number},
};

}  // namespace

LoadingStage stage_of(const Settings& s) {
    LoadingStage stage;
    stage.kind = static_cast<LoadingKind>(position_in(loading_kind_names, s.text("kind")));
    if (s.has("wall")) stage.wall = static_cast<Wall>(position_in(wall_names, s.text("wall")));
    if (s.has("axis")) stage.axis = position_in(axis_names, s.text("axis"));
    for (const OptionalKey& one : optional_keys) stage.*one.member = optional_number(s, one.key);
    if (s.has("pressure")) stage.stress_xx = stage.stress_yy = s.number("pressure");
    stage.tolerance = optional_number(s, "tolerance").value_or(stage.tolerance);
    stage.direction = optional_number(s, "direction").value_or(stage.direction);
    if (s.has("stages")) stage.stages = static_cast<int>(s.integer("stages"));
    if (s.has("times")) stage.times = static_cast<int>(s.integer("times"));
    stage.reverse = s.boolean("reverse");
    stage.gradient_xx = optional_number(s, "gradient_xx").value_or(0.0);
    stage.gradient_xy = optional_number(s, "gradient_xy").value_or(0.0);
    stage.gradient_yy = optional_number(s, "gradient_yy").value_or(0.0);
    return stage;
}

Settings settings_of(const LoadingStage& stage) {
    Settings s;
    s.set("kind", std::string(loading_kind_names[static_cast<std::size_t>(stage.kind)]));
    if (stage.kind == LoadingKind::oedometric)
        s.set("wall", std::string(wall_names[static_cast<std::size_t>(stage.wall)]));
    if (stage.kind == LoadingKind::uniaxial || stage.kind == LoadingKind::biaxial)
        s.set("axis", std::string(axis_names[static_cast<std::size_t>(stage.axis)]));
    for (const OptionalKey& one : optional_keys) set_optional(s, one.key, stage.*one.member);
    if (stage.seeks_stress()) s.set("tolerance", stage.tolerance);
    if (stage.kind == LoadingKind::probe) s.set("direction", stage.direction);
    if (stage.kind == LoadingKind::repeat) {
        s.set("stages", std::int64_t{stage.stages});
        s.set("times", std::int64_t{stage.times});
    }
    if (stage.reverse) s.set("reverse", true);
    if (stage.kind == LoadingKind::gradient) {
        s.set("gradient_xx", stage.gradient_xx);
        s.set("gradient_xy", stage.gradient_xy);
        s.set("gradient_yy", stage.gradient_yy);
    }
    return s;
}

}  // namespace softgrain::scenario_io
