// The example of docs/howto/method.md, as it stands there.
#include <gtest/gtest.h>

#include "app/methods.hpp"
#include "common/errors.hpp"
#include "common/observables/observable.hpp"
#include "common/packing/make_packing.hpp"
#include "common/time_loop.hpp"
#include "springs/method.hpp"
#include "tests/support/same_bits.hpp"

namespace softgrain {
namespace {

constexpr double strain = 0.012;

class Springs : public ::testing::Test {
  protected:
    Springs() {
        std::vector<MethodKeys> keys(method_keys().begin(), method_keys().end());
        keys.push_back({springs::method().name, springs::method().keys(), nullptr});
        scenario_ = parse_scenario(
            "[packing]\ncount = 20\n[[loading]]\nkind = \"isotropic\"\ninertial_number = 1e-3\nuntil_strain "
            "= 0.012\n",
            "springs.toml", {}, keys);
        packing_ = make_packing(scenario_);
    }
    std::unique_ptr<Solver> solver(const Method& method = springs::method()) const {
        return method.make(scenario_, packing_);
    }
    /// Last row of the history.
    std::vector<double> end_of_run(Solver& solver) const {
        TimeLoop loop(scenario_, packing_, solver, {});
        loop.go(std::atomic<int>{0});
        EXPECT_EQ(loop.state().ended, ended_in_order);
        return loop.state().history.back();
    }
    static double value(const std::vector<double>& row, std::string_view column) {
        return row[observable_index(column)];
    }

    Scenario scenario_;
    Packing packing_;
};

TEST_F(Springs, AgreeWithRigidDem) {
    const auto row = end_of_run(*solver()), rigid = end_of_run(*solver(find_method("rigid_dem")));
    ASSERT_GT(value(row, "mean_stress"), 1e-3);
    // Both have the same springs and lose energy in other ways: 0.08 % seen.
    EXPECT_NEAR(value(row, "mean_stress"), value(rigid, "mean_stress"), 0.005 * value(rigid, "mean_stress"));
    EXPECT_NEAR(value(row, "axial_strain"), strain, 1e-12);
    // 4e-5 seen; second order in the time step.
    EXPECT_LE(std::abs(value(row, "energy_residual")), 2e-4 * value(row, "external_work"));
}

TEST_F(Springs, ARestartedRunHasTheSameBits) {
    const auto close_in = [&](Solver& solver, Box box, int steps) {
        for (int k = 0; k < steps; ++k) {
            const WallMotion motion{box, {2e-3, -2e-3, 2e-3, -2e-3}};
            solver.advance(motion, solver.stable_time_step());
            box = motion.after(solver.stable_time_step());
        }
        return box;
    };
    testing::expect_restart_keeps_bits([&] { return solver(); },
                                       [&](Solver& s) { return close_in(s, packing_.box, 200); },
                                       [&](Solver& s, const Box& box) { return close_in(s, box, 200); });
}

TEST_F(Springs, RefusesFrictionInOneLine) {
    scenario_.material.friction = 0.3;
    EXPECT_THROW(solver(), InputError);
}

}  // namespace
}  // namespace softgrain
