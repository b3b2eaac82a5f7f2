#include "app/bench/rows.hpp"

#include <algorithm>

#include "app/report/curve_error.hpp"

namespace softgrain::bench {
namespace {

using report::Curve;

Cost cost_of(const std::vector<RunReport>& repeats) {
    std::vector<double> cpu, wall;
    double memory = 0.0;
    for (const RunReport& one : repeats) {
        cpu.push_back(one.cpu_time);
        wall.push_back(one.wall_time);
        memory = std::max(memory, one.peak_memory);
    }
    const auto [least, most] = std::ranges::minmax(cpu);
    return {median(cpu), least, most, median(wall), memory};
}

std::optional<Curve> scale_of(const Quantity& quantity, const Case& one) {
    if (!quantity.scale) return std::nullopt;
    return Curve{one.reference_over.of(*one.truth), quantity.scale->of(*one.truth)};
}

/// Error of a curve against the reference where both are.
std::optional<double> error_of(const Curve& curve, const Quantity& quantity, const Case& one) {
    const Curve truth{one.reference_over.of(*one.truth), quantity.reference.of(*one.truth)};
    const auto over = report::common_range(covered(curve), covered(truth));
    if (!over) return std::nullopt;
    const auto scale = scale_of(quantity, one);
    return report::relative_l2(curve, truth, *over, scale ? &*scale : nullptr);
}

std::optional<double> own_error_of(const Quantity& quantity, const Case& one) {
    if (!quantity.error) return std::nullopt;
    Curve off{one.reference_over.of(*one.truth), quantity.reference.of(*one.truth)};
    const std::vector<double> error = quantity.error->of(*one.truth);
    for (std::size_t k = 0; k < off.y.size(); ++k) off.y[k] += error[k];
    return error_of(off, quantity, one);
}

double coverage_of(const Curve& curve, const Case& one) {
    const auto whole = covered(Curve{one.reference_over.of(*one.truth), {}});
    const auto over = report::common_range(covered(curve), whole);
    return over ? (over->high - over->low) / (whole.high - whole.low) : 0.0;
}

Row row_of(const Measurement& measured) {
    Row row{measured.setting,
            measured.repeats.front(),
            measured.repeats.size(),
            cost_of(measured.repeats),
            {},
            0.0};
    if (!measured.history || measured.history->rows() == 0) return row;
    const Case& one = *measured.of;
    const std::vector<double> x = one.run_over.of(*measured.history);
    row.coverage = coverage_of({x, {}}, one);
    for (std::size_t q = 0; q < quantity_count; ++q)
        if (one.quantities[q])
            row.error[q] =
                error_of({x, one.quantities[q]->run.of(*measured.history)}, *one.quantities[q], one);
    return row;
}

}  // namespace

bool is_eligible(const Row& row) {
    return row.report.exit_code == 0 && row.coverage >= least_coverage && row.error[stress].has_value();
}

double CaseRows::known_error(const Row& row) const {
    return std::max(*row.error[stress], own_error[stress].value_or(0.0));
}

bool CaseRows::is_at_own_error(const Row& row, std::size_t quantity) const {
    return row.error[quantity] && own_error[quantity] && *row.error[quantity] <= *own_error[quantity];
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

std::vector<CaseRows> rows_by_case(const std::vector<Measurement>& measured) {
    std::vector<CaseRows> cases;
    for (const Measurement& one : measured) {
        if (one.repeats.empty()) continue;
        if (cases.empty() || cases.back().of != one.of) {
            CaseRows& next = cases.emplace_back(CaseRows{one.of, {}, {}});
            for (std::size_t q = 0; q < quantity_count; ++q)
                if (one.of->quantities[q]) next.own_error[q] = own_error_of(*one.of->quantities[q], *one.of);
        }
        cases.back().rows.push_back(row_of(one));
    }
    return cases;
}

}  // namespace softgrain::bench
