#pragma once
// Curves of several methods at equal packing fraction, and what each cost.
#include <optional>
#include <string>
#include <vector>

#include "app/run_folder.hpp"
#include "common/io/history_csv.hpp"

namespace softgrain {

/// A curve from elsewhere, shown beside the methods.
struct Reference {
    std::string name;
    History history;
};

struct MethodResult {
    RunReport report;
    std::optional<History> history;  ///< none if the run made no step
};

/// y where x first reaches `at` (linear between samples); none outside the range of x.
std::optional<double> at_first_passage(const std::vector<double>& x, const std::vector<double>& y, double at);

/// Value of a column where packing_fraction first reaches phi (linear between samples); none outside the
/// run's range.
std::optional<double> at_packing_fraction(const History& history, std::string_view column, double phi);

/// From the first to the largest packing fraction of any method; (1, 0) without any.
std::pair<double, double> packing_fraction_range(const std::vector<MethodResult>& results);

/// Round packing fractions that the loading of at least one method passes, at most `most`, evenly spread.
std::vector<double> packing_fractions_to_compare(const std::vector<MethodResult>& results, int most);

/// Stress (with its error against the reference, if there is one) and coordination at these packing
/// fractions, cost, and how each run ended, as Markdown.
std::string comparison_table(const std::vector<MethodResult>& results,
                             const std::optional<Reference>& reference, const std::vector<double>& phi);

/// The same as CSV with one row per method and packing fraction.
std::string comparison_csv(const std::vector<MethodResult>& results, const std::vector<double>& phi);

}  // namespace softgrain
