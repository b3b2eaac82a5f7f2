// Figure 6 of Nezamabadi et al. 2017: a grain between two walls yields at a constant stress.
#include <gtest/gtest.h>

#include <numbers>

#include "sample.hpp"

namespace softgrain::bpm {
namespace {

/// Mean of wall force / largest section for strains of 5 to 30 %, in F0/<a0>, at a wall speed of
/// 0.02 sqrt(F0 d/m).
double plateau(const Scenario& scenario) {
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

TEST(Plateau, SingleGrainYieldsNearTheKnownStress) {
    double mean = 0.0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) mean += plateau(scenario_of(300, seed)) / 3.0;
    // 0.163 to 0.189 over seeds, sizes and rates in an independent prototype. At this wall speed 0.204 +-
    // 0.006 (standard error of 8 seeds), a tenth above the slow limit; the mean of three seeds scatters by
    // 0.010.
    EXPECT_NEAR(mean, 0.20, 0.03);
}

TEST(Plateau, IsTheSameWithBox2D) {
    constexpr int seeds = 6;
    double nscd = 0.0, box2d = 0.0;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        Scenario scenario = scenario_of(100, seed);
        nscd += plateau(scenario) / seeds;
        scenario.method_settings.at("bpm").set("engine", "box2d");
        box2d += plateau(scenario) / seeds;
    }
    // Rearrangements are chaotic: single runs differ by 10 to 20 %, means of six by 5 %; measured 0.90.
    EXPECT_NEAR(box2d / nscd, 1.0, 0.15);
}

}  // namespace
}  // namespace softgrain::bpm
