#include "rigid_dem/parameters.hpp"

#include <cmath>
#include <numbers>

namespace softgrain::rigid_dem {
namespace {

/// Restitution of a spring and dashpot that never pull: the contact ends when the force is zero
/// (Schwager and Poeschel 2007, Granular Matter 9, 465).
double restitution(double zeta) {
    const double damped = std::sqrt(1.0 - zeta * zeta);
    const double duration =
        (std::numbers::pi - std::atan2(2.0 * zeta * damped, 1.0 - 2.0 * zeta * zeta)) / damped;
    return std::exp(-zeta * duration);
}

double damping_ratio(double wanted) {
    double low = 0.0;
    double high = 1.0 - 1e-9;
    while (high - low > 1e-12) (restitution(0.5 * (low + high)) > wanted ? low : high) = 0.5 * (low + high);
    return low;
}

}  // namespace

std::span<const KeySpec> keys() {
    using enum KeyType;
    static const std::vector<KeySpec> table{
        {"stiffness", number, 1.0, "E", "stiffness of one grain against a rigid wall; a pair has half of it",
         positive},
        {"shear_ratio", number, 0.5, "", "tangential over normal contact stiffness", positive},
        {"restitution", number, 0.5, "", "coefficient of restitution of a pair, sets the contact damping",
         Range{0.15, 1.0}},
        {"safety", number, 0.5, "", "share of the stability limit used as time step", Range{0.0, 1.0, true}},
        {"skin", number, 0.2, "smallest radius", "margin of the neighbour list", positive},
        {"overlap_limit", number, 0.1, "smaller radius",
         "largest overlap for which discs count as rigid; the run ends there", positive},
    };
    return table;
}

Parameters parameters_of(const Scenario& scenario) {
    const Settings& table = scenario.method_settings.at("rigid_dem");
    return {.stiffness = table.number("stiffness"),
            .shear_ratio = table.number("shear_ratio"),
            .friction = scenario.material.friction,
            .damping_ratio = damping_ratio(table.number("restitution")),
            .safety = table.number("safety"),
            .skin = table.number("skin"),
            .overlap_limit = table.number("overlap_limit")};
}

}  // namespace softgrain::rigid_dem
