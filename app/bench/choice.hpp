#pragma once
// Which setting to take: the Pareto front, the cheapest within an error, a default for each method.
#include <optional>
#include <string>
#include <vector>

#include "app/bench/rows.hpp"

namespace softgrain::bench {

/// Indices of the eligible rows that no other beats in both CPU time and known error, cheapest first.
std::vector<std::size_t> pareto_front(const CaseRows& one);

/// The cheapest eligible row with a known error of stress of at most this; of one method if it is named.
const Row* cheapest(const CaseRows& one, double most_error, const std::string& method = {});

/// The cheapest setting of a method that is nearly as good as can be on all cases. How bad a setting is: the
/// largest ratio, over the cases, of its error to the method's least; nearly: at most `worse_by` times the
/// smallest of these ratios. Cheap: geometric mean over the cases of CPU time. Only settings that are
/// eligible wherever any of the method's is; null if there is none.
inline constexpr double worse_by = 1.25;
const Setting* recommended(const std::vector<CaseRows>& cases, const std::string& method);

/// The row of a setting, or null.
const Row* row_of(const CaseRows& one, const Setting& setting);

/// How much cheaper the cheapest setting of a method within an error is than the last eligible one of a knob.
/// Rows are those of `cases`, which must outlive it.
struct Ratio {
    const Row *cheap, *dear;
    double times;
};
std::optional<Ratio> ratio_of(const Headline& headline, const std::vector<CaseRows>& cases);

}  // namespace softgrain::bench
