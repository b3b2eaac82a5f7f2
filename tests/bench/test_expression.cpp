// Sums and products of columns.
#include <gtest/gtest.h>

#include "app/bench/expression.hpp"
#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

History two_rows() {
    History history;
    history.columns["a"] = {2.0, 3.0};
    history.columns["b_2"] = {4.0, 0.5};
    return history;
}

TEST(Expression, ProductsComeBeforeSums) {
    EXPECT_EQ(Expression("a").of(two_rows()), (std::vector<double>{2.0, 3.0}));
    EXPECT_EQ(Expression("1 - a / b_2").of(two_rows()), (std::vector<double>{0.5, -5.0}));
    EXPECT_EQ(Expression("0.5 * a - a * b_2 / 2 + 1e1").of(two_rows()), (std::vector<double>{7.0, 10.75}));
    EXPECT_EQ(Expression("12 / a / b_2").of(two_rows()), (std::vector<double>{1.5, 8.0})) << "from the left";
    EXPECT_TRUE(Expression("a").of({{{"a", {}}}}).empty());
}

TEST(Expression, WrongTextsAreRefused) {
    for (const char* text : {"", "a +", "a b", "a ^ 2", "2a", "a-b", "+ a", "(a"})
        EXPECT_THROW(Expression{text}, InputError) << text;
    EXPECT_THROW(Expression("c").of(two_rows()), InputError);
}

}  // namespace
}  // namespace softgrain::bench
