#include "app/report/curve_error.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::report {
namespace {

constexpr double least_range = 1e-3;  ///< of packing fraction that is worth an error
constexpr int points = 400;           ///< of the integrals, more than samples of a run

/// A column of both curves at equal packing fractions.
struct Pair {
    std::vector<double> phi, value, truth;
};

std::optional<Pair> at_equal_packing_fraction(const History& history, const History& truth,
                                              std::string_view column, const Covered& over) {
    if (!history.columns.contains(column) || !truth.columns.contains(column)) return std::nullopt;
    Pair pair;
    for (int k = 0; k <= points; ++k) {
        const double phi = std::min(over.low + (over.high - over.low) * k / points, over.high);
        const auto a = at_packing_fraction(history, column, phi), b = at_packing_fraction(truth, column, phi);
        if (!a || !b || !std::isfinite(*a) || !std::isfinite(*b)) return std::nullopt;
        pair.phi.push_back(phi);
        pair.value.push_back(*a);
        pair.truth.push_back(*b);
    }
    return pair;
}

std::optional<double> relative_l2(const Pair& pair) {
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < pair.phi.size(); ++k) {
        const double weight = k == 0 || k + 1 == pair.phi.size() ? 0.5 : 1.0;
        difference += weight * std::pow(pair.value[k] - pair.truth[k], 2);
        size += weight * std::pow(pair.truth[k], 2);
    }
    return size > 0.0 ? std::optional(std::sqrt(difference / size)) : std::nullopt;
}

}  // namespace

std::optional<Truth> find_truth(const std::vector<MethodResult>& results,
                                const std::optional<Reference>& reference) {
    if (reference) return Truth{reference->name, &reference->history, nullptr};
    for (const MethodResult& result : results)
        if (result.report.method == "mpm" && result.history)
            return Truth{result.report.method, &*result.history, &result};
    return std::nullopt;
}

Covered covered(const History& history) {
    const auto& phi = history.column("packing_fraction");
    return {phi.front(), *std::max_element(phi.begin(), phi.end())};
}

std::optional<CurveError> curve_error(const History& history, const History& truth) {
    if (history.rows() == 0 || truth.rows() == 0) return std::nullopt;
    const Covered own = covered(history), whole = covered(truth);
    const Covered over{std::max(own.low, whole.low), std::min(own.high, whole.high)};
    if (!(over.high - over.low > least_range)) return std::nullopt;
    const auto stress = at_equal_packing_fraction(history, truth, "mean_stress", over);
    const auto error = stress ? relative_l2(*stress) : std::nullopt;
    if (!error) return std::nullopt;
    CurveError result{over, (over.high - over.low) / (whole.high - whole.low), *error, std::nullopt, 0.0,
                      0.0};
    double largest = -1.0;
    for (std::size_t k = 0; k < stress->phi.size(); ++k) {
        const double difference = std::abs(stress->value[k] - stress->truth[k]);
        if (!(difference > largest) || stress->truth[k] == 0.0) continue;
        largest = difference;
        result.worst_at = stress->phi[k];
        result.worst = stress->value[k] / stress->truth[k] - 1.0;
    }
    const auto coordination = at_equal_packing_fraction(history, truth, "coordination_number", over);
    if (coordination) result.coordination = relative_l2(*coordination);
    return result;
}

}  // namespace softgrain::report
