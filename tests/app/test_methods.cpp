#include <gtest/gtest.h>

#include "app/methods.hpp"

namespace softgrain {
namespace {

constexpr const char* text =
    "[[loading]]\nuntil_strain = 0.1\n"
    "[[loading]]\nkind = \"hold\"\nduration = 1\n"
    "[[loading]]\nuntil_strain = 0.2\nstrain_rate = 0.5\n";

TEST(ScenarioFor, StagesThatNameNoRateHaveTheMethodsOwn) {
    const Scenario scenario = parse_scenario(text, "s.toml", {}, method_keys());
    EXPECT_FALSE(scenario.loading[0].inertial_number);
    for (const Method& method : methods()) {
        const Scenario own = scenario_for(scenario, method);
        EXPECT_EQ(own.loading[0].inertial_number, method.inertial_number) << method.name;
        EXPECT_EQ(own.loading[0].inertial_number, method.name == "mpm" ? 1e-3 : 1e-2);
        EXPECT_FALSE(own.loading[1].inertial_number) << "a hold has no rate";
        EXPECT_FALSE(own.loading[2].inertial_number);
        EXPECT_EQ(own.loading[2].strain_rate, 0.5);
    }
}

TEST(ScenarioFor, ARateInTheMethodsTableIsForAllStages) {
    const Scenario own = scenario_for(
        parse_scenario(std::string(text) + "[sdem]\nstrain_rate = 0.25\n", "s.toml", {}, method_keys()),
        find_method("sdem"));
    for (const std::size_t stage : {0U, 2U}) {
        EXPECT_EQ(own.loading[stage].strain_rate, 0.25);
        EXPECT_FALSE(own.loading[stage].inertial_number);
    }
}

}  // namespace
}  // namespace softgrain
