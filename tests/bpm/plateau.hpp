#pragma once
// A single grain between two walls.
#include <numbers>

#include "sample.hpp"

namespace softgrain::bpm {

/// Mean of wall force / largest section for strains of 5 to 30 %, in F0/<a0>, at a wall speed of
/// 0.02 sqrt(F0 d/m).
inline double plateau(const Scenario& scenario) {
    Packing packing = square_packing(1, 1, 0.4);
    packing.box.position[0] -= 3.0;
    packing.box.position[1] += 3.0;
    BpmSolver solver(scenario, packing);
    const auto [low, high] = extent(solver, 1);
    Box box = packing.box;
    box.position[2] = low;
    box.position[3] = high;
    const double height = box.height();
    const double h = solver.stable_time_step();
    const double disc_mass = std::numbers::pi / static_cast<double>(solver.disc_position().size());
    const double speed = 0.02 * std::sqrt(solver.maximum_force() * solver.mean_disc_diameter() / disc_mass);
    double sum = 0.0;
    int samples = 0;
    while (box.height() > 0.7 * height) {
        const WallMotion walls{box, {0.0, 0.0, 0.0, -speed}};
        solver.advance(walls, h);
        box = walls.after(h);
        if (box.height() > 0.95 * height) continue;
        const auto [left, right] = extent(solver, 0);
        sum += 0.5 * (solver.wall_force()[3].y() - solver.wall_force()[2].y()) / (right - left);
        ++samples;
    }
    return sum / samples;
}

}  // namespace softgrain::bpm
