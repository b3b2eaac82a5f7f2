#pragma once
// One row for each case and setting: what it cost and how wrong it is.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/runner.hpp"

namespace softgrain::bench {

/// Of all repeats.
struct Cost {
    double cpu, cpu_min, cpu_max;  ///< median, least, most CPU time [s]
    double wall;                   ///< median [s]
    double memory;                 ///< most [bytes]
};

struct Row {
    const Setting* setting;
    RunReport report;  ///< of the first repeat: how it ended, with what program, on what machine
    std::size_t repeats;
    Cost cost;
    std::array<std::optional<double>, quantity_count> error;  ///< relative L2 over what is covered
    double coverage = 0.0;                                    ///< share of the reference's range
};

/// A method that covers less of the reference does not win.
inline constexpr double least_coverage = 0.8;

/// Ended in order, covers enough of the reference, and has an error of stress.
bool is_eligible(const Row& row);

struct CaseRows {
    const Case* of;
    std::array<std::optional<double>, quantity_count>
        own_error;          ///< of the reference, relative L2; where it is given
    std::vector<Row> rows;  ///< in the order of the plan

    /// Error of stress, or the reference's own where that is larger: what is below it means nothing.
    double known_error(const Row& row) const;
    bool is_at_own_error(const Row& row, std::size_t quantity) const;
};

/// Middle value, of an even number the mean of the two in the middle. At least one value.
double median(std::vector<double> values);

/// Those that were run, by case.
std::vector<CaseRows> rows_by_case(const std::vector<Measurement>& measured);

}  // namespace softgrain::bench
