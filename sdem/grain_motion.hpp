#pragma once
// The motion of grains under the forces of their contacts: inner stress, kick, constraints, drift.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "sdem/grain_sums.hpp"
#include "sdem/motion_block.hpp"

namespace softgrain::sdem {

/// "D2F0", "D2F1" or "D2F3"; throws InputError.
Kinematics kinematics_from(std::string_view name);

/// State that only some laws have.
struct GrainMemory {
    std::vector<double> caps_before;  ///< [n] cap fraction one evaluation ago; imposed area only
    /// [n] (Fp^T Fp)^-1, symmetric with determinant 1: xx, xy, yy. Plastic grains only.
    std::vector<double> plastic_xx, plastic_xy, plastic_yy;
};

/// Work done during a step, in the order of the grains.
struct StepWork {
    double stored = 0.0;   ///< against inner stress and contacts; 0 if the law has a potential [J]
    double damped = 0.0;   ///< by dashpots and shape damping [J]
    double plastic = 0.0;  ///< by plastic flow [J]
    double kinetic = 0.0;  ///< at the end of the kick [J]
    /// sum m u (x) u of the velocities u against the flow before the kick; periodic cells only [J]
    Tensor flux{0.0, 0.0, 0.0, 0.0};
};

struct MotionInput {
    ForceSource forces;
    std::span<const double> stress;  ///< [n] P of Pressures, empty for mollon2022
    MotionLaw law;
    /// Of a periodic cell, before and from now on: it takes the grains along, so velocities are kept against
    /// it, and works are done by the motion against it.
    WallMotion last_flow, flow;
};

/// A grain whose det F is not above this counts as crushed.
inline constexpr double smallest_area_ratio = 0.04;
/// Largest half axis / undeformed one of a grain that has not come apart.
inline constexpr double largest_stretch = 5.0;

/// False for a grain that in one step moved by more than half its radius, is crushed, inside out or torn
/// apart. moved2: way squared [m^2]; det: of F; reach: largest half axis [m].
inline bool sound(const Grain& grain, double moved2, double det, double reach) {
    return moved2 <= 0.25 * grain.radius * grain.radius && det > smallest_area_ratio &&
           reach <= largest_stretch * std::max(grain.a, grain.b);
}

/// One step of the grains [begin, end), at most grains_per_block of them: velocities are kicked, Eq. 58, then
/// positions drift, Eq. 59; kick and drift differ in length where the step changes. New centres go to
/// grains.next_center, as other grains still need the old ones. `bad` becomes the first
/// grain that is not sound.
StepWork move_grains(const MotionInput& in, Grains& grains, GrainMemory& memory, const StepTimes& times,
                     std::size_t begin, std::size_t end, std::size_t& bad);

/// The work of a kick, and the kinetic energy after it; changes nothing.
StepWork kick_work(const MotionInput& in, const Grains& grains, const GrainMemory& memory,
                   const StepTimes& times, std::size_t begin, std::size_t end);

/// Accelerations of grains at rest, as the velocities after a kick by one second.
void kick_from_rest(MotionBlock& block, const MotionInput& in, const Grains& grains,
                    const GrainMemory& memory, std::size_t begin, std::size_t end);
/// Lets plastic grains flow to their yield stress without moving; the work it takes [J].
double flow_grains(const MotionInput& in, const Grains& grains, GrainMemory& memory, std::size_t begin,
                   std::size_t end);

}  // namespace softgrain::sdem
