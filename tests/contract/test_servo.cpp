// Servo-control of every method: a restart keeps the bits.
#include <gtest/gtest.h>

#include <atomic>
#include <cstring>

#include "common/time_loop.hpp"
#include "tests/contract/scenes.hpp"
#include "tests/support/jammed_cell.hpp"

namespace softgrain {
namespace {

using namespace testing;

class Served : public ::testing::TestWithParam<Bands> {};

INSTANTIATE_TEST_SUITE_P(Methods, Served, ::testing::ValuesIn(all_bands()),
                         [](const auto& instance) { return instance.param.method; });

TEST(Equilibrium, IsThatOfTheMethodIfTheStageDoesNotSay) {
    const std::string text =
        "[[loading]]\nkind = \"stress\"\npressure = 1\nstrain_rate = 1\n[[loading]]\nuntil_strain = 0.5\n"
        "strain_rate = 1\n[[loading]]\nkind = \"hold\"\nduration = 1\nuntil_unbalanced = 0.2\n";
    const auto limits = [&](const char* method, const std::string& more) {
        const Scenario all =
            scenario_for(parse_scenario(text + more, "s.toml", {}, method_keys()), find_method(method));
        return std::vector{all.loading[0].until_unbalanced, all.loading[1].until_unbalanced,
                           all.loading[2].until_unbalanced};
    };
    using Limits = std::vector<std::optional<double>>;
    EXPECT_EQ(limits("sdem", ""), (Limits{packing_at_rest, std::nullopt, 0.2}));
    EXPECT_EQ(limits("bpm", ""), (Limits{1.0, std::nullopt, 0.2}));
    EXPECT_EQ(limits("bpm", "[bpm]\nuntil_unbalanced = 0.7\n"), (Limits{0.7, std::nullopt, 0.7}));
}

/// Consolidated, sheared by an axis or the cell against a constant stress, and stopped on the way.
TEST_P(Served, ARestartedRunHasTheSameBits) {
    const Packing packing = GetParam().cell > 0.0 ? jammed_cell(20) : jammed_box(9);
    const auto scale = make(GetParam(), served(GetParam(), {}), packing)->stress_scale();
    const double pressure = GetParam().servo_pressure * scale;
    LoadingStage consolidate = to_pressure(pressure, 5.0 * GetParam().servo_inertial_number);
    consolidate.until_unbalanced = 1.0;
    consolidate.tolerance = 0.1;
    LoadingStage biaxial = consolidate;
    biaxial.kind = LoadingKind::biaxial;
    biaxial.lateral_stress = pressure;
    biaxial.until_unbalanced.reset();
    biaxial.until_strain = 0.03;
    LoadingStage probe = consolidate;
    probe.kind = LoadingKind::probe;
    probe.direction = 45.0;
    probe.stress_amplitude = 0.2 * pressure;
    const Scenario all = served(GetParam(), {consolidate, biaxial, probe});
    const auto straight = make(GetParam(), all, packing);
    TimeLoop whole(all, packing, *straight, {});
    whole.go(std::atomic<int>{0});
    ASSERT_EQ(whole.state().ended, "loading done");
    Checkpoint one;
    whole.state().save(one);
    for (const double part : {0.3, 0.7, 0.98}) {
        Checkpoint loop, grains;
        const auto first = make(GetParam(), all, packing);
        TimeLoop begun(all, packing, *first, {});
        std::atomic<int> stop{0};
        begun.go(stop, [&] {
            stop = static_cast<double>(begun.state().step) >= part * static_cast<double>(whole.state().step);
        });
        begun.state().save(loop);
        first->save(grains);
        const auto second = make(GetParam(), all, packing);
        second->load(grains);
        RunState state;
        state.load(loop);
        TimeLoop rest(all, packing, *second, {});
        rest.resume(state);
        rest.go(std::atomic<int>{0});
        Checkpoint other;
        rest.state().save(other);
        for (const auto& [name, values] : one.numbers)
            EXPECT_TRUE(values.size() == other.numbers.at(name).size() &&
                        std::memcmp(values.data(), other.numbers.at(name).data(),
                                    values.size() * sizeof(double)) == 0)
                << name << ", stopped after " << part;
    }
}

}  // namespace
}  // namespace softgrain
