#include <gtest/gtest.h>

#include "common/thread_choice.hpp"

namespace softgrain {
namespace {

/// Share of the rounds done with threads, and all the time they took [s].
struct Course {
    double share = 0.0, time = 0.0;
};

/// Rounds of these lengths without and with threads [s].
Course run(ThreadChoice& choice, int rounds, double alone, double together) {
    Course course;
    for (int k = 0; k < rounds; ++k) {
        const double length = choice.parallel() ? together : alone;
        course.share += choice.parallel() ? 1.0 / rounds : 0.0;
        course.time += length;
        choice.note(length);
    }
    return course;
}

TEST(ThreadChoice, OneThreadIsNeverMany) {
    ThreadChoice choice(1);
    EXPECT_EQ(run(choice, 1000, 1.0, 0.5).share, 0.0);
}

TEST(ThreadChoice, ThreadsThatPayOffAreUsed) {
    ThreadChoice choice(2);
    run(choice, ThreadChoice::first_look, 1.0, 0.6);
    EXPECT_TRUE(choice.parallel());
    EXPECT_GT(run(choice, 100 * ThreadChoice::window, 1.0, 0.6).share, 0.95);
}

TEST(ThreadChoice, ThreadsThatCostMoreThanTheySaveAreLeft) {
    ThreadChoice choice(2);
    run(choice, 20 * ThreadChoice::window, 1.0, 1.1);
    EXPECT_LT(run(choice, 1000 * ThreadChoice::window, 1.0, 1.1).share, 0.02);
}

TEST(ThreadChoice, ACrowdedMachineCostsLittle) {
    ThreadChoice choice(2);
    // From the first round on: half a dozen trials of a round or two, ever further apart.
    EXPECT_LT(run(choice, 10 * ThreadChoice::window, 1.0, 200.0).time, 3.0 * 10 * ThreadChoice::window);
    EXPECT_LT(run(choice, 10 * ThreadChoice::window, 1.0, 10.0).time, 1.5 * 10 * ThreadChoice::window);
    const int rounds = 1000 * ThreadChoice::window;
    EXPECT_LT(run(choice, rounds, 1.0, 200.0).time, 1.1 * rounds);
}

TEST(ThreadChoice, AMachineThatIsFreeAgainIsUsedAgain) {
    ThreadChoice choice(2);
    run(choice, 2000 * ThreadChoice::window, 1.0, 200.0);
    run(choice, ThreadChoice::longest_pause * ThreadChoice::window, 1.0, 0.6);
    EXPECT_GT(run(choice, 100 * ThreadChoice::window, 1.0, 0.6).share, 0.95);
}

TEST(ThreadChoice, ThreadsInAnyCaseAreUsedHoweverSlow) {
    const ThreadsInAnyCase wanted;
    ThreadChoice choice(2), alone(1);
    EXPECT_NEAR(run(choice, 10 * ThreadChoice::window, 1.0, 200.0).share, 1.0, 1e-12);
    EXPECT_EQ(run(alone, 10 * ThreadChoice::window, 1.0, 0.5).share, 0.0);
}

TEST(ThreadChoice, NoThreadsInAnyCaseOnceThatHasEnded) {
    { const ThreadsInAnyCase wanted; }
    ThreadChoice choice(2);
    EXPECT_FALSE(choice.parallel());
}

}  // namespace
}  // namespace softgrain
