// Figure 6 of Nezamabadi et al. 2017: a grain between two walls yields at a constant stress.
#include <gtest/gtest.h>

#include "sample.hpp"

namespace softgrain::bpm {
namespace {

/// Mean of wall force / largest section for strains of 5 to 30 %, in F0/<a0>.
double plateau(std::uint64_t seed) {
    Packing packing = square_packing(1, 1, 0.4);
    packing.box.position[0] -= 3.0;
    packing.box.position[1] += 3.0;
    BpmSolver solver(scenario_of(300, seed), packing);
    const auto [low, high] = extent(solver, 1);
    Box box = packing.box;
    box.position[2] = low;
    box.position[3] = high;
    const double height = box.height();
    const double h = solver.stable_time_step();
    const double disc_mass = 3.14159265358979 / 300.0;
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

TEST(Plateau, SingleGrainYieldsNearTheKnownStress) {
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) mean += plateau(seed) / 3.0;
    // 0.163 to 0.189 over seeds, sizes and rates in an independent prototype. At this wall speed 0.204 +-
    // 0.006 (standard error of 8 seeds), a tenth above the slow limit; the mean of three seeds scatters by
    // 0.010.
    EXPECT_NEAR(mean, 0.20, 0.03);
}

}  // namespace
}  // namespace softgrain::bpm
