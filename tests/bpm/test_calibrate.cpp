#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "bpm/calibrate.hpp"
#include "common/errors.hpp"
#include "sample.hpp"

namespace softgrain::bpm {
namespace {

TEST(Calibrate, JohnsonsLineContactIsInverted) {
    for (double ratio : {1e-5, 1e-3, 0.05}) {  // F / (E* R)
        const double modulus = 7.0, radius = 0.3, force = ratio * modulus * radius;
        const double a = std::sqrt(4.0 * force * radius / (std::numbers::pi * modulus));
        const double strain =
            force / (std::numbers::pi * modulus * radius) * (2.0 * std::log(4.0 * radius / a) - 1.0);
        EXPECT_NEAR(johnson_modulus(force, strain, radius) / modulus, 1.0, 1e-12) << strain;
    }
}

TEST(Calibrate, SampleHasTheDeviationOfTheWholeEstimatedFromIt) {
    const Sample sample = sample_of({1.0, 2.0, 4.0, 5.0});
    EXPECT_EQ(sample.count, 4);
    EXPECT_DOUBLE_EQ(sample.mean, 3.0);
    EXPECT_DOUBLE_EQ(sample.deviation, std::sqrt(10.0 / 3.0));
    EXPECT_DOUBLE_EQ(sample.standard_error(), std::sqrt(10.0 / 12.0));
}

TEST(Calibrate, TheCurveCoversTheStrainsAndHoldsThePlateau) {
    const CompressionCurve curve = compress_grain(scenario_of(60), 1.0, 1);
    ASSERT_GE(curve.strain.size(), 60U);
    ASSERT_EQ(curve.strain.size(), curve.stress.size());
    double mean = 0.0;
    int intervals = 0;
    for (std::size_t k = 0; k < 60; ++k) {
        EXPECT_NEAR(curve.strain[k], 0.0025 + 0.005 * static_cast<double>(k), 1e-12);
        if (curve.strain[k] < plateau_begins) continue;
        mean += curve.stress[k];
        ++intervals;
    }
    // Intervals hold equally many steps, but for one.
    EXPECT_NEAR(mean / intervals / curve.plateau, 1.0, 0.01);
    EXPECT_GT(curve.modulus, 0.0);
}

TEST(Calibrate, ForcesScaleWithTheAttraction) {
    // Numbers scaled by a power of two: the same run to the bit.
    Scenario strong = scenario_of(40);
    strong.method_settings.at("bpm").set("attraction_stress", 4096.0);
    const CompressionCurve weak = compress_grain(scenario_of(40), 1.0, 3),
                           other = compress_grain(strong, 1.0, 3);
    EXPECT_EQ(other.plateau, 4096.0 * weak.plateau);
    EXPECT_NEAR(other.modulus / weak.modulus, 4096.0, 1e-9);
}

TEST(Calibrate, ReachesWhatWasAsked) {
    Scenario scenario = scenario_of(60);
    scenario.material.density = 2500.0;
    for (double radius : {1.0, 0.002}) {
        const Calibration c = calibrate(scenario, radius, GrainProperty::plateau, 35.0, 4);
        EXPECT_EQ(c.discs, 60);
        EXPECT_EQ(c.check_seeds, (std::vector<std::uint64_t>{5, 6, 7, 8}));
        EXPECT_DOUBLE_EQ(c.value * c.measured.mean, 35.0);
        // Known from an independent prototype: 0.18 F0/<a0>; grains of 60 discs scatter by 0.03.
        EXPECT_NEAR(c.measured.mean, 0.18, 0.05);
        // Four standard errors of both samples.
        const double error =
            std::hypot(c.reached.standard_error() / 35.0, c.measured.standard_error() / c.measured.mean);
        EXPECT_NEAR(c.reached.mean / 35.0, 1.0, 4.0 * error);
        EXPECT_LT(error, 0.2);
    }
}

TEST(Calibrate, ModulusIsThatOfTheSameSecant) {
    const Calibration c = calibrate(scenario_of(60), 1.0, GrainProperty::modulus, 2.0, 2);
    EXPECT_DOUBLE_EQ(c.value * c.measured.mean, 2.0);
    // Nearly rigid at first, yielding at 0.2 F0/<a0>: F = 0.4 R at a strain of 0.05 is E* = 11 F0/<a0>.
    EXPECT_GT(c.measured.mean, 1.0);
    EXPECT_LT(c.measured.mean, 30.0);
}

TEST(Calibrate, BondsOfElasticGrainsScaleTheModulus) {
    const Calibration c = calibrate(bonded_scenario_of(60), 1.0, GrainProperty::modulus, 2.0, 2);
    EXPECT_EQ(c.key, "bond_stiffness");
    EXPECT_DOUBLE_EQ(c.value * c.measured.mean, 2.0);
    EXPECT_NEAR(c.reached.mean, 2.0, 0.5);
}

TEST(Calibrate, RefusesWhatHasNoAnswer) {
    EXPECT_THROW(calibrate(bonded_scenario_of(60), 1.0, GrainProperty::plateau, 1.0, 2), InputError);
    EXPECT_THROW(calibrate(bonded_scenario_of(60, 0.01), 1.0, GrainProperty::modulus, 1.0, 2), InputError);
    EXPECT_THROW(calibrate(scenario_of(60), 1.0, GrainProperty::plateau, 0.0, 3), InputError);
    EXPECT_THROW(
        calibrate(scenario_of(60), 1.0, GrainProperty::plateau, std::numeric_limits<double>::quiet_NaN(), 3),
        InputError);
    EXPECT_THROW(calibrate(scenario_of(60), 1.0, GrainProperty::plateau, 1.0, 1), InputError);
    EXPECT_THROW(compress_grain(scenario_of(4), 1.0, 1), InputError);
}

}  // namespace
}  // namespace softgrain::bpm
