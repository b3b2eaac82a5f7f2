#pragma once
// Largest stable time step against the predicted one, over a grid of scenes.
#include <optional>
#include <string>
#include <vector>

#include "app/bench/stability/small_scene.hpp"

namespace softgrain::bench {

/// A method as it is run, and the values of each axis of its map.
struct MapPlan {
    std::string name, method;
    std::vector<std::string> set;
    std::string safety_key;  ///< "sdem.safety"; its value 1 is the predicted step. Empty: the default step is
    bool factor_by_key =
        false;                ///< what is tried is the key's value; otherwise predicted steps are multiplied
    std::vector<double> phi;  ///< undeformed area of the grains / area of the box
    std::vector<double> poisson_ratio, size_ratio, stiffness_ratio;
    std::vector<std::string> damping;  ///< KEY=VALUE KEY=VALUE
    int grains = 12;
    long long steps = 1000;  ///< that a step must stay stable for
};

struct MapCell {
    double phi, poisson_ratio, size_ratio, stiffness_ratio;
    std::string damping;
};

struct MapRow {
    const MapPlan* plan;
    MapCell cell;
    double largest = 0.0;           ///< stable step / predicted one
    double safety = 0.0;            ///< default step / predicted one
    double step = 0.0;              ///< the default one [s]
    std::string not_measured = {};  ///< why, if so

    /// How much longer the default step could be; below 1 it is unstable.
    double waste() const { return largest / safety; }
};

/// A factor is stable if kinetic energy stays below `most_growth` times that of the state at rest from which
/// it began, or a share `noise` of the elastic energy, for all steps, and the method does not diverge.
inline constexpr double most_growth = 100.0, noise = 1e-6;

/// Every combination of the axes. Ends early once stop_signal() is set.
std::vector<MapRow> step_map(const MapPlan& plan);

}  // namespace softgrain::bench
