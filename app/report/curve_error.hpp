#pragma once
// What errors are measured against, and how far a method is from it.
#include <optional>
#include <string>
#include <vector>

#include "app/comparison_table.hpp"

namespace softgrain::report {

inline constexpr double same_packing = 0.005;  ///< difference of packing fraction that is none

/// What the others are measured against.
struct Truth {
    std::string name;
    const History* history;
    const MethodResult* run;  ///< null if it is a curve from elsewhere
};
/// The given reference, else the run of mpm among the results, if it has a curve.
std::optional<Truth> find_truth(const std::vector<MethodResult>& results,
                                const std::optional<Reference>& reference);

/// A quantity y over what the loading increases.
struct Curve {
    std::vector<double> x, y;  ///< [n]
};

/// First and largest x of a curve, or packing fraction of a run.
struct Covered {
    double low, high;
};
Covered covered(const History& history);
Covered covered(const Curve& curve);

/// What both cover; none if that is less than 1e-3.
std::optional<Covered> common_range(const Covered& a, const Covered& b);

/// Root of the integral of the squared difference over that of the squared scale, which is the truth itself
/// where none is given; linear between samples, at the first passage of x. None if a curve does not pass the
/// whole range, or a value is not finite.
std::optional<double> relative_l2(const Curve& curve, const Curve& truth, const Covered& over,
                                  const Curve* scale = nullptr);

/// Relative L2 errors over the packing fractions that both curves pass.
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
