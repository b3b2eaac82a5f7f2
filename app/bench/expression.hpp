#pragma once
// Quantities made of the columns of a history or a reference: "stress_yy * box_width".
#include <string>
#include <string_view>
#include <vector>

#include "common/io/history_csv.hpp"

namespace softgrain::bench {

/// Column names and numbers joined by +, -, * and /, each with a space on both sides; products come before
/// sums.
class Expression {
  public:
    Expression() = default;
    /// Throws InputError saying what is wrong with the text.
    explicit Expression(std::string_view text);

    /// A value for each row. Throws InputError if there is no such column.
    std::vector<double> of(const History& history) const;
    const std::string& text() const { return text_; }

  private:
    struct Factor {
        bool divides;
        std::string column;  ///< empty for a number
        double number;
    };
    struct Term {
        double sign;
        std::vector<Factor> factors;
    };
    std::string text_;
    std::vector<Term> terms_;
};

}  // namespace softgrain::bench
