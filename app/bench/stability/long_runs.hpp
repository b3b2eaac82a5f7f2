#pragma once
// Very many steps of small scenes: energy that stays, comes back, and grains that do not move.
#include <string>
#include <vector>

#include "app/bench/stability/small_scene.hpp"

namespace softgrain::bench {

/// drift: a packing that nothing damps, set in motion by a fast squeeze, behind still walls or in a still
/// cell. cycle: a slow squeeze and back, nothing damps. rest: a packing at rest, held.
enum class LongKind { drift, cycle, rest };

struct LongPlan {
    std::string name;
    LongKind kind = LongKind::drift;
    SceneSpec scene;
    double phi = 0.9;        ///< undeformed area of the grains / area of the box
    double strain = 0.02;    ///< of a cycle
    long long steps = 1000;  ///< of drift and rest; of a cycle the least
};

struct LongRow {
    const LongPlan* plan;
    long long steps = 0;
    double waves = 0.0;  ///< simulated time / time of a wave through a mean grain
    /// drift: (mean energy of the last tenth - that of the first) / energy at the start.
    /// cycle: share of the work done on the packing that does not come back.
    /// rest: largest way of a grain / mean radius.
    double change = 0.0;
    /// drift: largest difference from the energy at the start / that energy. cycle: largest residual of the
    /// energy ledger / work. rest: largest relative change of the elastic energy.
    double largest = 0.0;
    std::string failed = {};  ///< why there are no numbers, if so
};

/// Ends early once stop_signal() is set.
std::vector<LongRow> long_runs(const std::vector<LongPlan>& plans, const std::vector<std::string>& methods);

}  // namespace softgrain::bench
