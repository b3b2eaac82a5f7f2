// Medians, errors of made-up runs, the Pareto front, the cheapest setting, recommendations.
#include "app/bench/choice.hpp"

#include <gtest/gtest.h>

#include "tests/bench/support.hpp"

namespace softgrain::bench {
namespace {

TEST(Rows, MedianOfOddAndEven) {
    EXPECT_EQ(median({3.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median({4.0, 1.0, 2.0, 9.0}), 3.0);
    EXPECT_EQ(median({7.0}), 7.0);
}

TEST(Rows, ErrorsAndCoverageAreThoseOfTheCurves) {
    Case one;
    one.name = "line";
    one.run_over = Expression("x");
    one.reference_over = Expression("e");
    one.quantities[stress] = {Expression("2 * y"), Expression("F"), Expression("0.05 * F"), std::nullopt};
    one.quantities[1] = {Expression("y"), Expression("F"), std::nullopt, Expression("2 * F")};
    one.truth.emplace().columns = {{"e", {0.0, 1.0}}, {"F", {0.0, 1.0}}};
    const Setting own = setting("sdem", "a");
    Measurement measured{&one, &own, std::vector<RunReport>(3), History{}};
    measured.history->columns = {{"x", {0.0, 0.9}}, {"y", {0.0, 0.495}}};  // 10 % too much, up to 0.9
    measured.repeats[0].cpu_time = 3.0;
    measured.repeats[1].cpu_time = 1.0;
    measured.repeats[2].cpu_time = 2.0;
    measured.repeats[1].peak_memory = 8.0;
    Measurement refused{&one, &own, std::vector<RunReport>(1), std::nullopt};
    refused.repeats[0].exit_code = 2;
    const auto cases = rows_by_case({measured, refused, {&one, &own, {}, {}}});
    ASSERT_EQ(cases.size(), 1U);
    ASSERT_EQ(cases[0].rows.size(), 2U) << "one that was not run is no row";
    const Row& row = cases[0].rows[0];
    EXPECT_NEAR(*row.error[stress], 0.1, 1e-12);
    EXPECT_NEAR(*row.error[1], 0.45 / 2.0, 1e-12) << "of twice the reference";
    EXPECT_FALSE(row.error[2]);
    EXPECT_NEAR(row.coverage, 0.9, 1e-12);
    EXPECT_NEAR(*cases[0].own_error[stress], 0.05, 1e-12);
    EXPECT_FALSE(cases[0].own_error[1]);
    EXPECT_EQ(row.cost.cpu, 2.0);
    EXPECT_EQ(row.cost.cpu_min, 1.0);
    EXPECT_EQ(row.cost.cpu_max, 3.0);
    EXPECT_EQ(row.cost.memory, 8.0);
    EXPECT_FALSE(is_eligible(cases[0].rows[1]));
    EXPECT_EQ(cases[0].rows[1].coverage, 0.0);
}

class Choice : public ::testing::Test {
  protected:
    void SetUp() override {
        one.rows.own_error[stress] = 0.02;
        one.add(fast, 1.0, 0.15);
        one.add(slow, 4.0, 0.04);
        one.add(slower, 8.0, 0.041);
        one.add(partial, 0.1, 0.001, 0.79);
        one.add(failed, 0.1, 0.001, 1.0, 3);
        one.add(fine, 100.0, 0.015);
        one.add(finer, 900.0, 0.001);
    }
    const Setting fast = setting("sdem", "fast"), slow = setting("sdem", "slow"),
                  slower = setting("sdem", "slower"), partial = setting("rigid_dem", "partial"),
                  failed = setting("bpm", "failed"), fine = setting("mpm", "fine"),
                  finer = setting("mpm", "finer");
    MadeUp one{"one"};
};

TEST_F(Choice, TheFrontLeavesOutWhatIsBeatenShortOrFailed) {
    EXPECT_EQ(pareto_front(one.rows), (std::vector<std::size_t>{0, 1, 5}));
    one.rows.own_error[stress].reset();
    EXPECT_EQ(pareto_front(one.rows), (std::vector<std::size_t>{0, 1, 5, 6}))
        << "below the reference's own error all is one";
}

TEST_F(Choice, EightyPerCentIsEnough) {
    MadeUp other("other");
    EXPECT_TRUE(is_eligible(other.add(fast, 1.0, 0.1, 0.8)));
    EXPECT_FALSE(is_eligible(other.add(fast, 1.0, 0.1, 0.799)));
}

TEST_F(Choice, TheCheapestWithinAnError) {
    EXPECT_EQ(cheapest(one.rows, 0.2)->setting, &fast);
    EXPECT_EQ(cheapest(one.rows, 0.1)->setting, &slow);
    EXPECT_EQ(cheapest(one.rows, 0.02)->setting, &fine);
    EXPECT_EQ(cheapest(one.rows, 0.01), nullptr) << "below the reference's own error";
    EXPECT_EQ(cheapest(one.rows, 0.2, "mpm")->setting, &fine);
    EXPECT_EQ(cheapest(one.rows, 0.2, "rigid_dem"), nullptr) << "covers too little";
}

TEST_F(Choice, RecommendedIsGoodOnAllCasesAndThenCheap) {
    EXPECT_EQ(recommended({one.rows}, "sdem"), &slow) << "slower is as good";
    EXPECT_EQ(recommended({one.rows}, "bpm"), nullptr) << "it failed";
    MadeUp other("other");
    other.add(slow, 4.0, 0.2);
    other.add(slower, 8.0, 0.1);
    EXPECT_EQ(recommended({one.rows, other.rows}, "sdem"), &slower) << "slow is twice as wrong on the other";
    other.add(fast, 1.0, 0.05);
    EXPECT_EQ(recommended({one.rows, other.rows}, "sdem"), &slower)
        << "2 times the least at most, of fast it is 3.75";
    other.rows.rows[1].coverage = 0.5;
    EXPECT_EQ(recommended({one.rows, other.rows}, "sdem"), &fast) << "3.75 times at most, of slow it is 4";
    other.rows.rows[0].report.exit_code = other.rows.rows[2].report.exit_code = 3;
    EXPECT_EQ(recommended({one.rows, other.rows}, "sdem"), &slow) << "the other case does not count";
}

TEST_F(Choice, RatioIsOfTheCheapestToTheLastOfTheKnob) {
    Headline headline{"one", "sdem", "knob", 0.1, 200.0};
    const std::vector<CaseRows> cases{one.rows};
    const auto ratio = ratio_of(headline, cases);
    ASSERT_TRUE(ratio);
    EXPECT_EQ(ratio->cheap->setting, &slow);
    EXPECT_EQ(ratio->dear->setting, &finer);
    EXPECT_DOUBLE_EQ(ratio->times, 225.0);
    headline.error = 0.03;
    EXPECT_FALSE(ratio_of(headline, cases));
    headline = {"other", "sdem", "knob", 0.1, 200.0};
    EXPECT_FALSE(ratio_of(headline, cases));
}

}  // namespace
}  // namespace softgrain::bench
