#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/io/scenario_checks.hpp"
#include "common/io/scenario_stages.hpp"

namespace softgrain::scenario_io {
namespace {

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

std::size_t ends_of(const CheckedTable& stage) {
    return static_cast<std::size_t>(std::count_if(
        stage.given.begin(), stage.given.end(),
        [](const auto& given) { return given.first.starts_with("until_") || given.first == "duration"; }));
}

/// Where the stage leaves the strains. Only a stage with one end, and that a strain, is sure to reach it.
Strains after(const CheckedTable& table, const LoadingStage& stage, Strains now) {
    const StagePlan plan = plan_of(stage, {});
    const bool one_end = ends_of(table) == 1;
    const auto known = [](bool sure, double value) { return sure ? std::optional(value) : std::nullopt; };
    if (plan.progress == ProgressMeasure::time) return {{std::nullopt, std::nullopt}, std::nullopt};
    if (now.shear != 0.0) now.shear.reset();  // the cell is stretched
    for (std::size_t a = 0; a < 2; ++a)
        if (plan.target[a]) now.axial[a].reset();
    if (plan.progress == ProgressMeasure::shear_strain) {
        now.shear = known(one_end && stage.until_shear, stage.until_shear.value_or(0.0));
    } else if (plan.progress == ProgressMeasure::strain_path) {
        for (std::size_t a = 0; a < 2; ++a)
            now.axial[a] = known(ends_of(table) == 0 && now.axial[a],
                                 now.axial[a].value_or(0.0) + plan.share[a] * *stage.strain_amplitude);
    } else if (plan.progress == ProgressMeasure::axial_strain) {
        const auto along = static_cast<std::size_t>(plan.axis);
        const bool sure = one_end && stage.until_strain;
        const double until = stage.until_strain.value_or(0.0);
        const double way = until - now.axial[along].value_or(0.0);
        if (plan.share[1 - along] != 0.0)
            now.axial[1 - along] = known(sure && now.axial[along] && now.axial[1 - along],
                                         now.axial[1 - along].value_or(0.0) + way);
        now.axial[along] = known(sure, until);
    }
    return now;
}

/// False if an error was reported already, so that the course is not known from here on.
bool is_known(const CheckedTable& table) {
    const auto& kind = table.settings.text("kind");
    if (kind == "oedometric" && !table.has("wall")) return false;
    if (kind == "probe" && !table.has("stress_amplitude") && !table.has("strain_amplitude")) return false;
    return table.sound({"kind", "wall", "axis", "until_strain", "until_shear", "reverse", "direction",
                        "strain_amplitude", "stress_amplitude", "stages"});
}

/// The strains after one stage.
void follow(const CheckedTable& table, Strains& now, ErrorList& errors) {
    const LoadingStage stage = stage_of(table.settings);
    if (stage.kind == LoadingKind::hold) return;
    const StagePlan plan = plan_of(stage, {});
    if (plan.progress == ProgressMeasure::shear_strain) check_ahead(table, "until_shear", now.shear, errors);
    if (plan.progress == ProgressMeasure::axial_strain)
        check_ahead(table, "until_strain", now.axial[static_cast<std::size_t>(plan.axis)], errors);
    now = after(table, stage, now);
}

}  // namespace

void check_course(std::span<const CheckedTable> stages, ErrorList& errors) {
    Strains now;
    for (std::size_t k = 0; k < stages.size(); ++k) {
        if (!is_known(stages[k])) return;
        if (stages[k].settings.text("kind") != "repeat") {
            follow(stages[k], now, errors);
            continue;
        }
        // The first time again tells of all: every later one begins where it began.
        const auto back =
            stages[k].has("stages") ? static_cast<std::size_t>(stages[k].settings.integer("stages")) : k + 1;
        if (back > k) return;
        const auto repeated = stages.subspan(k - back, back);
        if (std::any_of(repeated.begin(), repeated.end(),
                        [](const CheckedTable& stage) { return stage.settings.text("kind") == "repeat"; }))
            return;
        ErrorList again(errors);
        for (const CheckedTable& stage : repeated) follow(stage, now, again);
        if (again.size() > errors.size())
            errors.add(
                stages[k].place_of("stages"), stages[k].full("stages"),
                "repeats a stage that would have to go back: end the last of them where the first began");
    }
}

}  // namespace softgrain::scenario_io
