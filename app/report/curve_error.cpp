#include "app/report/curve_error.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain::report {
namespace {

constexpr double least_range = 1e-3;  ///< of packing fraction or strain that is worth an error
constexpr int points = 400;           ///< of the integrals, more than samples of a run

double x_of(const Covered& over, int k) {
    return std::min(over.low + (over.high - over.low) * k / points, over.high);
}

std::optional<Curve> column_over_packing_fraction(const History& history, std::string_view column) {
    if (!history.columns.contains(column)) return std::nullopt;
    return Curve{history.column("packing_fraction"), history.column(column)};
}

/// The values of a curve at all points of the range.
std::optional<std::vector<double>> values(const Curve& curve, const Covered& over) {
    std::vector<double> all;
    for (int k = 0; k <= points; ++k) {
        const auto value = at_first_passage(curve.x, curve.y, x_of(over, k));
        if (!value || !std::isfinite(*value)) return std::nullopt;
        all.push_back(*value);
    }
    return all;
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

Covered covered(const Curve& curve) {
    return {curve.x.front(), *std::max_element(curve.x.begin(), curve.x.end())};
}

Covered covered(const History& history) {
    return covered(Curve{history.column("packing_fraction"), {}});
}

std::optional<Covered> common_range(const Covered& a, const Covered& b) {
    const Covered over{std::max(a.low, b.low), std::min(a.high, b.high)};
    return over.high - over.low > least_range ? std::optional(over) : std::nullopt;
}

std::optional<double> relative_l2(const Curve& curve, const Curve& truth, const Covered& over,
                                  const Curve* scale) {
    const auto value = values(curve, over), true_value = values(truth, over),
               unit = values(scale ? *scale : truth, over);
    if (!value || !true_value || !unit) return std::nullopt;
    double difference = 0.0, size = 0.0;
    for (std::size_t k = 0; k < value->size(); ++k) {
        const double weight = k == 0 || k + 1 == value->size() ? 0.5 : 1.0;
        difference += weight * std::pow((*value)[k] - (*true_value)[k], 2);
        size += weight * std::pow((*unit)[k], 2);
    }
    return size > 0.0 ? std::optional(std::sqrt(difference / size)) : std::nullopt;
}

std::optional<CurveError> curve_error(const History& history, const History& truth) {
    if (history.rows() == 0 || truth.rows() == 0) return std::nullopt;
    const Covered whole = covered(truth);
    const auto over = common_range(covered(history), whole);
    if (!over) return std::nullopt;
    const auto error_of = [&](std::string_view column) -> std::optional<double> {
        const auto own = column_over_packing_fraction(history, column),
                   true_one = column_over_packing_fraction(truth, column);
        return own && true_one ? relative_l2(*own, *true_one, *over) : std::nullopt;
    };
    const auto error = error_of("mean_stress");
    if (!error) return std::nullopt;
    CurveError result{*over,  (over->high - over->low) / (whole.high - whole.low),
                      *error, error_of("coordination_number"),
                      0.0,    0.0};
    double largest = -1.0;
    for (int k = 0; k <= points; ++k) {
        const double phi = x_of(*over, k);
        const double value = *at_packing_fraction(history, "mean_stress", phi),
                     true_value = *at_packing_fraction(truth, "mean_stress", phi);
        const double difference = std::abs(value - true_value);
        if (!(difference > largest) || true_value == 0.0) continue;
        largest = difference;
        result.worst_at = phi;
        result.worst = value / true_value - 1.0;
    }
    return result;
}

}  // namespace softgrain::report
