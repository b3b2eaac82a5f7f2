#include <gtest/gtest.h>

#include "bpm/prepare_grains.hpp"
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

TEST(BpmMethod, AHundredDiscsUnlessTheirDiameterIsGiven) {
    EXPECT_EQ(discs_in_grain(settings_of(Scenario()), 2.0, 2.0), 100);
    Scenario scenario;
    Settings settings(method().keys());
    settings.set("disc_diameter", 0.1);
    scenario.method_settings.insert_or_assign("bpm", settings);
    // Whatever the other grains: 0.86 (1 / 0.1)^2 discs if they were alike; <d^2> is 1.02 <d>^2 here.
    EXPECT_EQ(discs_in_grain(settings_of(scenario), 0.5, 0.3), 84);
    EXPECT_EQ(discs_in_grain(settings_of(scenario), 0.05, 0.3), 1);
    EXPECT_THROW(discs_in_grain(settings_of(scenario), 0.049, 0.3), InputError);
    EXPECT_THROW(discs_in_grain(settings_of(scenario), 60.0, 0.3), InputError);
}

TEST(BpmMethod, KeysThatContradictEachOtherAreNamed) {
    const auto faults = [](const std::vector<std::pair<const char*, Value>>& given) {
        Settings settings(method().keys());
        for (const auto& [key, value] : given) settings.set(key, value);
        std::string keys;
        for (const KeyFault& fault : method().faults(settings)) keys += std::string(fault.key) + " ";
        Scenario scenario;
        scenario.method_settings.insert_or_assign("bpm", settings);
        if (keys.empty())
            EXPECT_NO_THROW(settings_of(scenario));
        else
            EXPECT_THROW(settings_of(scenario), InputError) << keys;
        return keys;
    };
    const std::string elastic = "elastic", brittle = "brittle", box2d = "box2d";
    EXPECT_EQ(faults({}), "");
    EXPECT_EQ(faults({{"discs_per_grain", std::int64_t{30}}, {"disc_diameter", 0.1}}), "disc_diameter ");
    EXPECT_EQ(faults({{"bond_stiffness", 1.0}}), "bond_stiffness ");
    EXPECT_EQ(faults({{"bond_stiffness", 1.0}, {"grain", elastic}}), "");
    EXPECT_EQ(faults({{"bond_strength", 1.0}, {"grain", elastic}}), "bond_strength ");
    EXPECT_EQ(faults({{"grain", brittle}}), "grain ");
    EXPECT_EQ(faults({{"grain", brittle}, {"bond_strength", 1.0}}), "");
    EXPECT_EQ(faults({{"engine", box2d}, {"grain", elastic}, {"friction_within", 0.1}}),
              "grain friction_within ");
    EXPECT_EQ(faults({{"box2d_velocity_iterations", std::int64_t{4}}}), "box2d_velocity_iterations ");
}

TEST(BpmMethod, DiscsHaveTheDiameterAsked) {
    for (const char* law : {"uniform_volume", "uniform", "single"})
        for (double ratio : {1.625, 4.0}) {
            Scenario scenario = scenario_of(1);
            Settings settings(method().keys());
            settings.set("attraction_stress", 1.0);
            settings.set("disc_diameter", 0.19);
            settings.set("disc_size_law", std::string(law));
            settings.set("disc_size_ratio", ratio);
            scenario.method_settings.insert_or_assign("bpm", settings);
            Packing packing = square_packing(2, 1, 0.5);
            packing.radius = {1.0, 0.7};
            const BpmSolver solver(scenario, packing);
            // 2 % from the packing fraction inside a grain; the drawn sizes have a standard error of
            // 0.5 / sqrt(140) = 4 % at ratio 4 and of 1 % at 1.625.
            EXPECT_NEAR(solver.mean_disc_diameter() / 0.19, 1.0, ratio == 4.0 ? 0.1 : 0.04) << law;
        }
}

TEST(BpmMethod, ADiscPerGrainIsARigidGrain) {
    const Packing packing = square_packing(2, 1, 0.1);
    BpmSolver solver(scenario_of(1), packing);
    EXPECT_EQ(solver.disc_position().size(), 2U);
    EXPECT_DOUBLE_EQ(solver.disc_radius()[0], 1.0);
    const WallMotion walls = closing(packing.box, 0.01);
    for (int k = 0; k < 10; ++k) solver.advance(walls, solver.stable_time_step());
    EXPECT_NEAR(solver.view(Need::area).area[0], 3.14159265358979, 1e-12);
}

TEST(BpmMethod, StepFollowsTheSmallestOfVeryUnequalDiscs) {
    Scenario scenario = scenario_of(80);
    scenario.method_settings.at("bpm").set("disc_size_ratio", 20.0);
    const Packing packing = square_packing(2, 1, 0.2);
    BpmSolver solver(scenario, packing);
    double least = 1e9, square_sum = 0.0;
    for (double r : solver.disc_radius()) {
        least = std::min(least, r);
        square_sum += r * r;
    }
    const double least_mass = 2.0 * 3.14159265358979 * least * least / square_sum;
    // The discs of the two grains have a slightly different mass per area.
    EXPECT_NEAR(solver.stable_time_step() / (0.07 * std::sqrt(2.0 * least_mass)), 1.0, 0.01);
    Box box = packing.box;
    while (box.width() > 0.93 * packing.box.width()) {
        const WallMotion walls = closing(box, 0.03);
        solver.advance(walls, solver.stable_time_step());
        box = walls.after(solver.stable_time_step());
    }
    const GrainView view = solver.view(Need::all);
    EXPECT_FALSE(solver.outside_validity().has_value());
    EXPECT_LT(solver.penetration(), 5e-4);
    for (double area : view.area) EXPECT_NEAR(area / 3.14159265358979, 1.0, 0.05);
    const double residual =
        view.energy.external_work - view.energy.kinetic - view.energy.elastic - view.energy.dissipated();
    EXPECT_GT(view.energy.external_work, 0.01);
    EXPECT_LT(std::abs(residual), 5e-3 * view.energy.external_work);
}

TEST(BpmMethod, EnergyLedgerClosesForEveryAttraction) {
    for (const auto& [exponent, range] : std::vector<std::pair<double, double>>{
             {1.0, 1.0}, {2.0, 3.0}, {3.5, 1.0}, {12.0, 0.3}, {7.0, 0.05}, {30.0, 1.0}}) {
        Scenario scenario = scenario_of(50);
        scenario.method_settings.at("bpm").set("attraction_exponent", exponent);
        scenario.method_settings.at("bpm").set("attraction_range", range);
        const Packing packing = square_packing(2, 1, 0.05);
        BpmSolver solver(scenario, packing);
        Box box = packing.box;
        while (box.width() > 0.96 * packing.box.width()) {
            const WallMotion walls = closing(box, 0.03);
            solver.advance(walls, solver.stable_time_step());
            box = walls.after(solver.stable_time_step());
        }
        const EnergyLedger energy = solver.view(Need::base).energy;
        const double residual = energy.external_work - energy.kinetic - energy.elastic - energy.dissipated();
        EXPECT_GT(energy.external_work, 0.01);
        // Errors of integrating the attraction, its jump at a short cut-off included: measured up to 4e-3.
        EXPECT_LT(std::abs(residual), 1.5e-2 * energy.external_work) << exponent << " " << range;
    }
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
