#include <gtest/gtest.h>

#include "common/errors.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

TEST(BpmMethod, EveryKeyIsDescribedAndItsDefaultIsAllowed) {
    EXPECT_EQ(method().name, "bpm");
    for (const KeySpec& key : method().keys()) {
        EXPECT_FALSE(key.help.empty()) << key.name;
        double value = 0.0;
        if (const auto* number = std::get_if<double>(&key.default_value))
            value = *number;
        else if (const auto* integer = std::get_if<std::int64_t>(&key.default_value))
            value = static_cast<double>(*integer);
        else
            continue;
        EXPECT_GE(value, key.range.min) << key.name;
        EXPECT_LE(value, key.range.max) << key.name;
    }
}

TEST(BpmMethod, AttractionFollowsTheModulusUnlessGiven) {
    Scenario scenario;
    scenario.material.youngs_modulus = 200.0;
    EXPECT_DOUBLE_EQ(settings_of(scenario).attraction_stress, 56.0);
    EXPECT_DOUBLE_EQ(settings_of(scenario_of(20)).attraction_stress, 1.0);
}

TEST(BpmMethod, MakesASolverWithTheStepAndStressOfItsSettings) {
    const auto solver = method().make(scenario_of(20), square_packing(2, 1, 0.5));
    EXPECT_EQ(solver->stress_scale(), 1.0);
    const auto& bpm = dynamic_cast<const BpmSolver&>(*solver);
    const double mass = 2.0 * 3.14159265358979 / 40.0;  // density 1, two grains of 20 discs
    EXPECT_NEAR(bpm.maximum_force(), bpm.mean_disc_diameter(), 1e-12);
    EXPECT_NEAR(bpm.stable_time_step(), 0.07 * std::sqrt(mass), 1e-12);
}

TEST(BpmMethod, LargerGrainsHaveMoreDiscsOfTheSameSize) {
    Packing packing = square_packing(2, 1, 1.0);
    packing.radius = {0.5, 1.5};
    packing.center = {{1.0, 2.0}, {3.5, 2.0}};
    const BpmSolver solver(scenario_of(60), packing);
    const int small = solver.grain_start()[1];
    const int large = solver.grain_start()[2] - small;
    EXPECT_EQ(small, 15);   // 60 (0.5 / 1)^2
    EXPECT_EQ(large, 135);  // 60 (1.5 / 1)^2
    const auto mean = [&](int first, int last) {
        double sum = 0.0;
        for (int d = first; d < last; ++d) sum += solver.disc_radius()[static_cast<std::size_t>(d)];
        return sum / (last - first);
    };
    EXPECT_NEAR(mean(0, small) / mean(small, small + large), 1.0,
                0.12);  // 15 discs: 0.13 / sqrt(15) and surface
}

TEST(BpmMethod, RefusesAPackingWithoutRoom) {
    Packing packing = square_packing(2, 2, 0.0);
    packing.box.position = {0.3, 3.7, 0.3, 3.7};  // undeformed packing fraction 1.09
    EXPECT_THROW(BpmSolver(scenario_of(20), packing), InputError);
    EXPECT_THROW(BpmSolver(scenario_of(20), Packing{}), InputError);
}

}  // namespace
}  // namespace softgrain::bpm
