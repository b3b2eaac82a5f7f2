#pragma once
// What a kind of loading stage means for each axis of the box. Kinds are names for combinations.
#include <array>
#include <optional>

#include "common/scenario.hpp"

namespace softgrain {

/// Stress asked of each axis, compression positive [N/m]; none: the axis is not servo-controlled.
using StressTargets = std::array<std::optional<double>, 2>;

/// What the progress of a stage is counted in. It grows steadily in every one, so samples are at equal steps.
enum class ProgressMeasure {
    time,          ///< hold, gradient [s]
    axial_strain,  ///< along the loading axis
    shear_strain,
    strain_path,  ///< probe by strain: sum over the axes of share times strain
    most_strain,  ///< stress-driven: the integral of the largest rate allowed over time
};

struct StagePlan {
    ProgressMeasure progress = ProgressMeasure::axial_strain;
    int axis = 0;                        ///< along which axial strain is counted: 0 x, 1 y
    std::array<double, 2> share{};       ///< strain rate of each axis / rate of the stage; 0: it stands
    StressTargets target{};              ///< servo-controlled axes; their share is 0
    std::array<double, 2> band{};        ///< from the target within which it counts as reached [N/m]
    double shear = 0.0;                  ///< d(tilt / height)/dt / rate of the stage
    std::optional<Wall> only_wall = {};  ///< moves instead of both walls of its axis

    bool has_servo() const { return target[0] || target[1]; }
};

/// `stress` is that of each axis at the start of the stage, which a probe starts from [N/m].
StagePlan plan_of(const LoadingStage& stage, const std::array<double, 2>& stress);

}  // namespace softgrain
