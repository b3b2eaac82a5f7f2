#pragma once
// Repeats that must give the same bits: a restart, and any number of threads.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

#include "common/solver.hpp"
#include "common/thread_choice.hpp"

namespace softgrain::testing {

inline Checkpoint saved(const Solver& solver) {
    Checkpoint c;
    solver.save(c);
    return c;
}

/// Bitwise, so that -0 is not 0; what is not a number is the same as nothing.
inline ::testing::AssertionResult same_bits(const Checkpoint& a, const Checkpoint& b) {
    if (a.integers != b.integers) return ::testing::AssertionFailure() << "whole numbers differ";
    if (a.numbers.size() != b.numbers.size())
        return ::testing::AssertionFailure() << "one has more arrays than the other";
    for (const auto& [name, values] : a.numbers) {
        const auto other = b.numbers.find(name);
        if (other == b.numbers.end() || other->second.size() != values.size())
            return ::testing::AssertionFailure() << name << " is missing or of another size";
        for (std::size_t k = 0; k < values.size(); ++k)
            if (std::isnan(values[k]) || std::memcmp(&values[k], &other->second[k], sizeof(double)) != 0)
                return ::testing::AssertionFailure()
                       << name << "[" << k << "]: " << values[k] << " and " << other->second[k];
    }
    return ::testing::AssertionSuccess();
}

/// `first` runs a new solver and returns its box; from there `then` runs on, once straight, once from what
/// was saved. `look` sees both solvers where the second begins.
template <class Make, class First, class Then, class Look>
void expect_restart_keeps_bits(const Make& make, const First& first, const Then& then, const Look& look) {
    const auto straight = make();
    const Box box = first(*straight);
    const Checkpoint middle = saved(*straight);
    const auto restarted = make();
    restarted->load(middle);
    EXPECT_TRUE(same_bits(middle, saved(*restarted))) << "what was loaded is not what was saved";
    EXPECT_EQ(straight->stable_time_step(), restarted->stable_time_step());
    look(*straight, *restarted);
    then(*straight, box);
    then(*restarted, box);
    EXPECT_TRUE(same_bits(saved(*straight), saved(*restarted)));
    EXPECT_EQ(straight->stable_time_step(), restarted->stable_time_step());
}
template <class Make, class First, class Then>
void expect_restart_keeps_bits(const Make& make, const First& first, const Then& then) {
    expect_restart_keeps_bits(make, first, then, [](Solver&, Solver&) {});
}

/// `drive` runs a new solver with each of these numbers of threads, used from the first step on.
template <class Make, class Drive>
void expect_threads_keep_bits(const Make& make, std::initializer_list<int> threads, const Drive& drive) {
    const ThreadsInAnyCase wanted;
    const int before = omp_get_max_threads();
    std::vector<Checkpoint> results;
    for (const int n : threads) {
        omp_set_num_threads(n);
        const auto solver = make();
        drive(*solver);
        results.push_back(saved(*solver));
    }
    omp_set_num_threads(before);
    for (const Checkpoint& result : results) EXPECT_TRUE(same_bits(results.front(), result));
}

}  // namespace softgrain::testing
