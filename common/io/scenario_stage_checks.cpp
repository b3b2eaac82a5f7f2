#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <optional>

#include "common/io/scenario_checks.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_stages.hpp"

namespace softgrain::scenario_io {
namespace {

using Kinds = unsigned;  // a bit for each LoadingKind
using enum LoadingKind;

template <class... Kind>
constexpr Kinds kinds(Kind... one) {
    return ((1U << static_cast<unsigned>(one)) | ...);
}

constexpr Kinds axial = kinds(isotropic, oedometric, uniaxial, biaxial);
constexpr Kinds by_rate = axial | kinds(shear);
constexpr Kinds to_stress = kinds(stress, probe);
constexpr Kinds with_end = by_rate | to_stress | kinds(hold, gradient);

/// The kinds that a key is for, and what to use instead for the others.
struct KeyUse {
    std::string_view key;
    Kinds kinds;
    std::string_view instead = "remove it";
};
constexpr std::array key_uses{
    KeyUse{"wall", kinds(oedometric)},
    KeyUse{"axis", kinds(uniaxial, biaxial)},
    KeyUse{"lateral_stress", kinds(biaxial)},
    KeyUse{"normal_stress", kinds(shear)},
    KeyUse{"pressure", kinds(stress)},
    KeyUse{"stress_xx", kinds(stress), "use until_stress_xx or remove it"},
    KeyUse{"stress_yy", kinds(stress), "use until_stress_yy or remove it"},
    KeyUse{"tolerance", to_stress},
    KeyUse{"direction", kinds(probe)},
    KeyUse{"stress_amplitude", kinds(probe)},
    KeyUse{"strain_amplitude", kinds(probe)},
    KeyUse{"stages", kinds(repeat)},
    KeyUse{"times", kinds(repeat)},
    KeyUse{"until_strain", axial, "use until_shear for a shear, or remove it"},
    KeyUse{"until_shear", kinds(shear), "use until_strain"},
    KeyUse{"until_packing_fraction", by_rate | kinds(stress)},
    KeyUse{"until_packing_fraction_undeformed", by_rate | kinds(stress)},
    KeyUse{"until_stress", by_rate, "use pressure for a stress, or remove it"},
    KeyUse{"until_stress_xx", by_rate, "use stress_xx for a stress, or remove it"},
    KeyUse{"until_stress_yy", by_rate, "use stress_yy for a stress, or remove it"},
    KeyUse{"until_stress_ratio", by_rate},
    KeyUse{"until_unbalanced", with_end & ~kinds(gradient)},
    KeyUse{"duration", with_end},
    KeyUse{"strain_rate", by_rate | to_stress},
    KeyUse{"inertial_number", by_rate | to_stress},
    KeyUse{"reverse", by_rate},
    KeyUse{"gradient_xx", kinds(gradient)},
    KeyUse{"gradient_xy", kinds(gradient)},
    KeyUse{"gradient_yy", kinds(gradient)},
};

std::string names_of(Kinds some) {
    std::vector<std::string_view> names;
    for (std::size_t k = 0; k < loading_kind_names.size(); ++k)
        if ((some >> k & 1U) != 0) names.push_back(loading_kind_names[k]);
    return fmt::format("{}", fmt::join(names, ", "));
}

/// One stage, and what is said about it.
class StageCheck {
  public:
    StageCheck(const CheckedTable& stage, ErrorList& errors)
        : stage_(stage), errors_(errors), name_(stage.settings.text("kind")) {
        kind_ = static_cast<LoadingKind>(position_in(loading_kind_names, name_));
    }

    void check(std::size_t number, std::span<const CheckedTable> stages, const CheckedTable& box) {
        check_strangers();
        if ((kind_ == shear || kind_ == gradient) && box.sound({"periodic"}) &&
            !box.settings.boolean("periodic"))
            errors_.add(stage_.place_of("kind"), stage_.full("kind"),
                        fmt::format("= \"{}\" needs a periodic cell: set box.periodic = true", name_));
        check_needs();
        if (kind_ == repeat) check_repeat(number, stages);
        if (is(by_rate)) check_end();
        if (is(by_rate | to_stress)) not_both("strain_rate", "inertial_number");
    }

  private:
    bool is(Kinds some) const { return (some & kinds(kind_)) != 0; }
    bool has(std::string_view key) const { return stage_.has(key); }
    void must(std::string_view key, std::string_view why) {
        if (!has(key)) errors_.add(stage_.place, stage_.full(key), fmt::format("must be given {}", why));
    }
    void not_both(std::string_view first, std::string_view second) {
        if (!has(first) || !has(second)) return;
        const Place& place = std::max(stage_.place_of(first), stage_.place_of(second),
                                      [](const Place& a, const Place& b) { return a.line < b.line; });
        errors_.add(place, stage_.path, fmt::format("has both {} and {}: remove one", first, second));
    }

    void check_strangers() {
        for (const KeyUse& use : key_uses)
            if (has(use.key) && !is(use.kinds))
                errors_.add(
                    stage_.place_of(use.key), stage_.full(use.key),
                    fmt::format("is for kind {} only, not {}: {}", names_of(use.kinds), name_, use.instead));
        if (kind_ == shear && !has("normal_stress") && has("until_packing_fraction_undeformed"))
            errors_.add(stage_.place_of("until_packing_fraction_undeformed"),
                        stage_.full("until_packing_fraction_undeformed"),
                        "is not for a shear without normal_stress, which keeps the area: remove it");
    }

    void check_needs() {
        if (kind_ == oedometric) must("wall", "for an oedometric stage: left, right, bottom or top");
        if (kind_ == biaxial) must("lateral_stress", "for a biaxial stage");
        if (kind_ == repeat) must("stages", "for a repeat: how many stages before it");
        if (is(kinds(hold, gradient))) must("duration", fmt::format("for a {}, which ends after it", name_));
        if (kind_ == gradient) check_moves();
        if (kind_ == stress) {
            if (!has("pressure") && !has("stress_xx") && !has("stress_yy"))
                errors_.add(stage_.place, stage_.path,
                            "has no stress to go to: give pressure, or stress_xx, stress_yy or both");
            not_both("pressure", "stress_xx");
            not_both("pressure", "stress_yy");
        }
        if (kind_ == probe) {
            must("direction", "for a probe: 0 is +xx, 90 is +yy");
            if (!has("stress_amplitude") && !has("strain_amplitude"))
                errors_.add(stage_.place, stage_.path,
                            "has no amplitude: give stress_amplitude or strain_amplitude");
            not_both("stress_amplitude", "strain_amplitude");
            not_both("strain_amplitude", "tolerance");
        }
    }

    void check_moves() {
        constexpr std::array<std::string_view, 3> keys{"gradient_xx", "gradient_xy", "gradient_yy"};
        const bool moves = std::any_of(keys.begin(), keys.end(), [&](std::string_view key) {
            return has(key) && (!stage_.sound({key}) || stage_.settings.number(key) != 0.0);
        });
        if (!moves)
            errors_.add(stage_.place, stage_.path,
                        "has no velocity gradient: give gradient_xx, gradient_xy or gradient_yy");
    }

    void check_end() {
        const bool ends = std::any_of(stage_.given.begin(), stage_.given.end(), [](const auto& given) {
            return given.first.starts_with("until_") || given.first == "duration";
        });
        if (!ends)
            errors_.add(stage_.place, stage_.path,
                        fmt::format("has no end: give {}, until_packing_fraction, until_stress, duration or "
                                    "another until_... key",
                                    kind_ == shear ? "until_shear" : "until_strain"));
    }

    /// What is repeated is there, and is no repeat itself.
    void check_repeat(std::size_t number, std::span<const CheckedTable> stages) {
        if (!has("stages") || !stage_.sound({"stages"})) return;
        const auto back = static_cast<std::size_t>(stage_.settings.integer("stages"));
        if (back > number) {
            errors_.add(stage_.place_of("stages"), stage_.full("stages"),
                        fmt::format("must be at most {}, the stages before it, got {}", number, back));
            return;
        }
        const auto repeated = stages.subspan(number - back, back);
        if (std::any_of(repeated.begin(), repeated.end(), [](const CheckedTable& one) {
                return one.sound({"kind"}) && one.settings.text("kind") == "repeat";
            }))
            errors_.add(stage_.place_of("stages"), stage_.full("stages"),
                        "reaches back to another repeat: write out what it repeats");
    }

    const CheckedTable& stage_;
    ErrorList& errors_;
    const std::string& name_;
    LoadingKind kind_;
};

}  // namespace

bool is_for(std::string_view key, LoadingKind kind) {
    const auto* use = std::ranges::find(key_uses, key, &KeyUse::key);
    return use == key_uses.end() || (use->kinds & kinds(kind)) != 0;
}

void check_stage(std::span<const CheckedTable> stages, std::size_t number, const CheckedTable& box,
                 ErrorList& errors) {
    if (stages[number].sound({"kind"})) StageCheck(stages[number], errors).check(number, stages, box);
}

}  // namespace softgrain::scenario_io
