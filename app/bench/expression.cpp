#include "app/bench/expression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <sstream>

#include "common/errors.hpp"

namespace softgrain::bench {
namespace {

bool is_column(std::string_view word) {
    const auto in_name = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; };
    return std::isalpha(static_cast<unsigned char>(word.front())) != 0 && std::ranges::all_of(word, in_name);
}

}  // namespace

Expression::Expression(std::string_view text) : text_(text) {
    std::stringstream stream{text_};
    std::string symbol = "+";
    do {
        std::string word;
        if (!(stream >> word))
            throw InputError(fmt::format("\"{}\" ends where a column or a number should stand", text));
        Factor factor{symbol == "/", {}, 0.0};
        const char* end = word.data() + word.size();
        if (is_column(word))
            factor.column = word;
        else if (const auto [stop, error] = std::from_chars(word.data(), end, factor.number);
                 error != std::errc{} || stop != end)
            throw InputError(fmt::format("'{}' in \"{}\" is no column and no number", word, text));
        if (symbol == "+" || symbol == "-") terms_.push_back({symbol == "-" ? -1.0 : 1.0, {}});
        terms_.back().factors.push_back(std::move(factor));
        if (!(stream >> symbol)) return;
    } while (symbol == "+" || symbol == "-" || symbol == "*" || symbol == "/");
    throw InputError(fmt::format("'{}' in \"{}\" stands where +, -, * or / should", symbol, text));
}

std::vector<double> Expression::of(const History& history) const {
    std::vector<double> sum(history.rows(), 0.0);
    for (const Term& term : terms_) {
        std::vector<double> product(history.rows(), term.sign);
        for (const Factor& factor : term.factors) {
            const std::vector<double>* column =
                factor.column.empty() ? nullptr : &history.column(factor.column);
            for (std::size_t k = 0; k < product.size(); ++k) {
                const double value = column ? (*column)[k] : factor.number;
                product[k] = factor.divides ? product[k] / value : product[k] * value;
            }
        }
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] += product[k];
    }
    return sum;
}

}  // namespace softgrain::bench
