// Figure 6 of Nezamabadi et al. 2017: a grain between two walls yields at a constant stress.
#include <gtest/gtest.h>

#include "plateau.hpp"

namespace softgrain::bpm {
namespace {

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
