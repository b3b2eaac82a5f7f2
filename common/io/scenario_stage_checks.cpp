#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "common/io/scenario_checks.hpp"
#include "common/io/scenario_schema.hpp"

namespace softgrain::scenario_io {
namespace {

constexpr std::array<std::string_view, 3> gradient_keys{"gradient_xx", "gradient_xy", "gradient_yy"};

bool is_end(std::string_view key) {
    return key.starts_with("until_");
}

bool is_gradient(std::string_view key) {
    return key.starts_with("gradient_");
}

void check_hold(const CheckedTable& stage, ErrorList& errors) {
    if (!stage.has("duration"))
        errors.add(stage.place, stage.full("duration"), "must be given: a hold ends after it");
    for (const auto& [key, given] : stage.given)
        if (key != "kind" && key != "duration")
            errors.add(given.place, stage.full(key), "is not for a hold, whose walls stand still: remove it");
}

void check_gradient(const CheckedTable& stage, ErrorList& errors) {
    if (!stage.has("duration"))
        errors.add(stage.place, stage.full("duration"), "must be given: a gradient ends after it");
    for (const auto& [key, given] : stage.given)
        if (key != "kind" && key != "duration" && !is_gradient(key))
            errors.add(given.place, stage.full(key),
                       "is not for a gradient, whose velocity gradient and duration say all: remove it");
    const bool moves = std::any_of(gradient_keys.begin(), gradient_keys.end(), [&](std::string_view key) {
        return stage.has(key) && (!stage.sound({key}) || stage.settings.number(key) != 0.0);
    });
    if (!moves)
        errors.add(stage.place, stage.path,
                   "has no velocity gradient: give gradient_xx, gradient_xy or gradient_yy");
}

/// Keys that this kind of moving stage has no use for.
void check_strangers(const CheckedTable& stage, const std::string& kind, ErrorList& errors) {
    const bool shear = kind == "shear";
    if (kind == "oedometric" && !stage.has("wall"))
        errors.add(stage.place, stage.full("wall"),
                   "must be given for an oedometric stage: left, right, bottom or top");
    const auto not_for = [&](std::string_view key, std::string_view why) {
        if (stage.has(key)) errors.add(stage.place_of(key), stage.full(key), why);
    };
    if (kind == "isotropic") not_for("wall", "is not for an isotropic stage, all walls move: remove it");
    if (shear) {
        not_for("wall", "is not for a shear, whose cell has no moving walls: remove it");
        not_for("until_strain", "is not for a shear: use until_shear");
        not_for("until_packing_fraction_undeformed", "is not for a shear, which keeps the area: remove it");
    } else {
        not_for("until_shear", "is for a shear only: use until_strain");
    }
    not_for("duration", "is for a hold or a gradient only: use an until_... key");
    for (const std::string_view key : gradient_keys) not_for(key, "is for a gradient only: remove it");
}

void check_moving_stage(const CheckedTable& stage, const std::string& kind, ErrorList& errors) {
    check_strangers(stage, kind, errors);
    if (std::none_of(stage.given.begin(), stage.given.end(), [](const auto& g) { return is_end(g.first); }))
        errors.add(stage.place, stage.path,
                   kind == "shear" ? "has no end: give until_shear, until_packing_fraction or until_stress"
                                   : "has no end: give until_strain, until_packing_fraction, "
                                     "until_packing_fraction_undeformed or "
                                     "until_stress");
    if (stage.has("strain_rate") && stage.has("inertial_number"))
        errors.add(std::max(stage.place_of("strain_rate"), stage.place_of("inertial_number"),
                            [](const Place& a, const Place& b) { return a.line < b.line; }),
                   stage.path, "has both strain_rate and inertial_number: remove one");
    if (!stage.has("strain_rate") && !stage.has("inertial_number"))
        errors.add(stage.place, stage.path, "has no speed: give strain_rate or inertial_number");
}

/// Strains at a point of the course, where they are known.
struct Strains {
    std::array<std::optional<double>, 2> axial{0.0, 0.0};
    std::optional<double> shear = 0.0;
};

/// An end given as a strain lies ahead.
void check_ahead(const CheckedTable& stage, std::string_view key, const std::optional<double>& now,
                 ErrorList& errors) {
    if (!now || !stage.has(key)) return;
    const double until = stage.settings.number(key);
    const bool reverse = stage.settings.boolean("reverse");
    if (reverse ? until < *now : until > *now) return;
    errors.add(stage.place_of(key), stage.full(key),
               reverse
                   ? fmt::format("must be below {:.6g}, where the stage begins, to be reached in reverse, "
                                 "got {}",
                                 *now, until)
                   : fmt::format("must be above {:.6g}, where the stage begins, got {}; set reverse = "
                                 "true to go back",
                                 *now, until));
}

/// Where the stage leaves the strains. Only a stage with one end, and that a strain, is sure to reach it.
Strains after(const CheckedTable& stage, const std::string& kind, Strains strains) {
    const auto ends =
        std::count_if(stage.given.begin(), stage.given.end(), [](const auto& g) { return is_end(g.first); });
    if (kind == "gradient") return {{std::nullopt, std::nullopt}, std::nullopt};
    if (kind == "shear") {
        const bool sure = ends == 1 && stage.has("until_shear");
        strains.shear = sure ? std::optional(stage.settings.number("until_shear")) : std::nullopt;
        return strains;
    }
    if (strains.shear != 0.0) strains.shear.reset();  // the height changes
    const bool sure = ends == 1 && stage.has("until_strain");
    const double until = sure ? stage.settings.number("until_strain") : 0.0;
    if (kind == "oedometric") {
        const std::string& wall = stage.settings.text("wall");
        auto& axial = strains.axial[wall == "left" || wall == "right" ? 0 : 1];
        axial = sure ? std::optional(until) : std::nullopt;
        return strains;
    }
    const bool both = sure && strains.axial[0] && strains.axial[1];
    const double way = both ? until - *strains.axial[0] : 0.0;
    strains.axial[1] = both ? std::optional(*strains.axial[1] + way) : std::nullopt;
    strains.axial[0] = sure ? std::optional(until) : std::nullopt;
    return strains;
}

}  // namespace

void check_stage(const CheckedTable& stage, const CheckedTable& box, ErrorList& errors) {
    if (!stage.sound({"kind"})) return;
    const std::string& kind = stage.settings.text("kind");
    if ((kind == "shear" || kind == "gradient") && box.sound({"periodic"}) &&
        !box.settings.boolean("periodic"))
        errors.add(stage.place_of("kind"), stage.full("kind"),
                   fmt::format("= \"{}\" needs a periodic cell: set box.periodic = true", kind));
    if (kind == "hold")
        check_hold(stage, errors);
    else if (kind == "gradient")
        check_gradient(stage, errors);
    else
        check_moving_stage(stage, kind, errors);
}

void check_course(std::span<const CheckedTable> stages, ErrorList& errors) {
    Strains now;
    for (const CheckedTable& stage : stages) {
        const std::string& kind = stage.settings.text("kind");
        const bool needs_wall = kind == "oedometric" && !stage.settings.has("wall");
        if (needs_wall || !stage.sound({"kind", "wall", "until_strain", "until_shear", "reverse"}))
            return;  // reported already; what follows is not known
        if (kind == "hold") continue;
        if (kind == "shear") check_ahead(stage, "until_shear", now.shear, errors);
        if (kind == "isotropic") check_ahead(stage, "until_strain", now.axial[0], errors);
        if (kind == "oedometric") {
            const std::string& wall = stage.settings.text("wall");
            check_ahead(stage, "until_strain", now.axial[wall == "left" || wall == "right" ? 0 : 1], errors);
        }
        now = after(stage, kind, now);
    }
}

}  // namespace softgrain::scenario_io
