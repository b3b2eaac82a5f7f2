#include "common/stage_plan.hpp"

#include <cmath>
#include <numbers>

namespace softgrain {
namespace {

StagePlan along(int axis) {
    StagePlan plan;
    plan.axis = axis;
    plan.share[static_cast<std::size_t>(axis)] = 1.0;
    return plan;
}

StagePlan probe(const LoadingStage& stage, const std::array<double, 2>& stress) {
    const double angle = stage.direction * std::numbers::pi / 180.0;
    const std::array<double, 2> toward{std::cos(angle), std::sin(angle)};
    if (!stage.stress_amplitude) return {.progress = ProgressMeasure::strain_path, .share = toward};
    StagePlan plan{.progress = ProgressMeasure::most_strain};
    for (std::size_t a = 0; a < 2; ++a) {
        plan.target[a] = stress[a] + *stage.stress_amplitude * toward[a];
        plan.band[a] = stage.tolerance * *stage.stress_amplitude;
    }
    return plan;
}

}  // namespace

StagePlan plan_of(const LoadingStage& stage, const std::array<double, 2>& stress) {
    StagePlan plan;
    switch (stage.kind) {
        case LoadingKind::isotropic:
            plan.share = {1.0, 1.0};
            break;
        case LoadingKind::oedometric:
            plan = along(wall_axis(static_cast<int>(stage.wall)));
            plan.only_wall = stage.wall;
            break;
        case LoadingKind::uniaxial:
            plan = along(stage.axis);
            break;
        case LoadingKind::biaxial:
            plan = along(stage.axis);
            plan.target[static_cast<std::size_t>(1 - stage.axis)] = stage.lateral_stress;
            break;
        case LoadingKind::shear:
            plan.progress = ProgressMeasure::shear_strain;
            plan.shear = 1.0;
            plan.target[1] = stage.normal_stress;
            break;
        case LoadingKind::stress:
            plan.progress = ProgressMeasure::most_strain;
            plan.target = {stage.stress_xx, stage.stress_yy};
            for (std::size_t a = 0; a < 2; ++a) plan.band[a] = stage.tolerance * plan.target[a].value_or(0.0);
            break;
        case LoadingKind::probe:
            return probe(stage, stress);
        case LoadingKind::hold:
        case LoadingKind::gradient:
        case LoadingKind::repeat:  // never run itself
            plan.progress = ProgressMeasure::time;
            break;
    }
    return plan;
}

}  // namespace softgrain
