#pragma once
// Small scenarios for the tests of the bonded-particle method.
#include <cmath>
#include <optional>

#include "bpm/method.hpp"
#include "bpm/solver.hpp"

namespace softgrain::bpm {

/// Attraction stress 1 N/m, density 1, so that the units are sqrt(F0 d/m) ~ 1.
inline Scenario scenario_of(int discs, std::uint64_t seed = 1, double friction = 0.0) {
    Scenario scenario;
    scenario.seed = seed;
    scenario.material.friction = friction;
    Settings settings(method().keys());
    settings.set("discs_per_grain", std::int64_t{discs});
    settings.set("attraction_stress", 1.0);
    scenario.method_settings.insert_or_assign("bpm", settings);
    return scenario;
}

/// Grains held by bonds of stiffness 1 N/m, that break at `strength` if it is given.
inline Scenario bonded_scenario_of(int discs, std::optional<double> strength = std::nullopt) {
    Scenario scenario;
    Settings settings(method().keys());
    settings.set("discs_per_grain", std::int64_t{discs});
    settings.set("grain", std::string(strength ? "brittle" : "elastic"));
    settings.set("bond_stiffness", 1.0);
    if (strength) settings.set("bond_strength", *strength);
    scenario.method_settings.insert_or_assign("bpm", settings);
    return scenario;
}

/// columns x rows grains of radius 1, `gap` apart, in a box that is `gap` wider.
inline Packing square_packing(int columns, int rows, double gap) {
    Packing packing;
    const double pitch = 2.0 + gap;
    packing.box.position = {0.0, pitch * columns + gap, 0.0, pitch * rows + gap};
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            packing.center.emplace_back(gap + 1.0 + pitch * column, gap + 1.0 + pitch * row);
            packing.radius.push_back(1.0);
        }
    return packing;
}

/// Wall motion that closes in on all sides with `speed`.
inline WallMotion closing(const Box& box, double speed) {
    return {box, {speed, -speed, speed, -speed}};
}

/// Four grains pressed together.
struct Pressed {
    Packing packing = square_packing(2, 2, 0.1);
    BpmSolver solver;
    Box box = packing.box;

    explicit Pressed(double friction = 0.0) : solver(scenario_of(60, 1, friction), packing) {
        const double h = solver.stable_time_step();
        for (int k = 0; k < 400; ++k) press(0.03, h);
        // Come to rest: forces between grains and on walls balance.
        for (int k = 0; k < 400; ++k) press(0.0, h);
    }
    void press(double speed, double h) {
        const WallMotion walls = closing(box, speed);
        solver.advance(walls, h);
        box = walls.after(h);
    }
};

}  // namespace softgrain::bpm
