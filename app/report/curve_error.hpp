#pragma once
// What errors are measured against, and how far a method is from it.
#include <optional>
#include <string>
#include <vector>

#include "app/comparison_table.hpp"

namespace softgrain::report {

/// What the others are measured against.
struct Truth {
    std::string name;
    const History* history;
    const MethodResult* run;  ///< null if it is a curve from elsewhere
};
/// The given reference, else the run of mpm among the results, if it has a curve.
std::optional<Truth> find_truth(const std::vector<MethodResult>& results,
                                const std::optional<Reference>& reference);

/// First and largest packing fraction of a run.
struct Covered {
    double low, high;
};
Covered covered(const History& history);

/// Errors over the packing fractions that both curves pass. Relative L2: the root of the integral of the
/// squared difference over that of the squared truth.
struct CurveError {
    Covered over;
    double share;                        ///< of the truth's range that is covered
    double stress;                       ///< of mean_stress
    std::optional<double> coordination;  ///< of coordination_number; none if either curve has none
    double worst_at;                     ///< packing fraction of the largest difference of stress
    double worst;                        ///< relative difference of stress there, with its sign
};
/// None if the curves have (nearly) no packing fraction in common, or a value is not finite.
std::optional<CurveError> curve_error(const History& history, const History& truth);

}  // namespace softgrain::report
