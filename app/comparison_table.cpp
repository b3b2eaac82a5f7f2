#include "app/comparison_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/markdown_table.hpp"

namespace softgrain {
namespace {

using Row = std::vector<std::string>;

std::string number(std::optional<double> value, const char* format) {
    return value ? fmt::format(fmt::runtime(format), *value) : "-";
}

std::optional<double> value_at(const MethodResult& result, std::string_view column, double phi) {
    return result.history ? at_packing_fraction(*result.history, column, phi) : std::nullopt;
}

double cost_per_grain_step(const RunReport& r) {
    return r.steps > 0 ? 1e6 * r.cpu_time / static_cast<double>(r.steps) / static_cast<double>(r.grains)
                       : 0.0;
}

}  // namespace

std::optional<double> at_first_passage(const std::vector<double>& x, const std::vector<double>& y,
                                       double at) {
    for (std::size_t k = 1; k < x.size(); ++k) {
        if (!(x[k - 1] <= at && at <= x[k])) continue;
        const double t = x[k] > x[k - 1] ? (at - x[k - 1]) / (x[k] - x[k - 1]) : 0.0;
        return y[k - 1] + t * (y[k] - y[k - 1]);
    }
    return std::nullopt;
}

std::optional<double> at_packing_fraction(const History& history, std::string_view column, double phi) {
    return at_first_passage(history.column("packing_fraction"), history.column(column), phi);
}

std::pair<double, double> packing_fraction_range(const std::vector<MethodResult>& results) {
    double low = 1.0;
    double high = 0.0;
    for (const MethodResult& result : results) {
        if (!result.history) continue;
        const auto& phi = result.history->column("packing_fraction");
        low = std::min(low, phi.front());
        high = std::max(high, *std::max_element(phi.begin(), phi.end()));
    }
    return {low, high};
}

std::vector<double> packing_fractions_to_compare(const std::vector<MethodResult>& results, int most) {
    const auto [low, high] = packing_fraction_range(results);
    std::vector<double> chosen;
    if (!(high > low)) return chosen;
    double step = 0.005;
    for (const double next : {0.01, 0.02, 0.04, 0.05, 0.1})
        if ((high - low) / step > most) step = next;
    for (double k = std::ceil(low / step); k * step <= high && static_cast<int>(chosen.size()) < most;
         k += 1.0)
        chosen.push_back(k * step);
    return chosen;
}

std::string comparison_table(const std::vector<MethodResult>& results,
                             const std::optional<Reference>& reference, const std::vector<double>& phi) {
    std::vector<Row> stress{{"mean stress [N/m] at phi"}};
    std::vector<Row> coordination{{"Z at phi"}};
    for (const double p : phi) {
        stress.front().push_back(fmt::format("{:.3f}", p));
        coordination.front().push_back(fmt::format("{:.3f}", p));
    }
    std::vector<Row> cost{{"cost", "wall time [s]", "CPU time [s]", "steps", "CPU per grain and step [us]",
                           "CPU per grain [ms]", "memory [MB]"}};
    const auto add_reference = [&](std::vector<Row>& rows, std::string_view column, const char* format) {
        if (!reference) return;
        rows.push_back({reference->name});
        for (const double p : phi)
            rows.back().push_back(number(at_packing_fraction(reference->history, column, p), format));
    };
    add_reference(stress, "mean_stress", "{:.3e}");
    add_reference(coordination, "coordination_number", "{:.2f}");
    std::string endings;
    for (const MethodResult& result : results) {
        const RunReport& r = result.report;
        stress.push_back({r.method});
        coordination.push_back({r.method});
        for (const double p : phi) {
            const auto mean_stress = value_at(result, "mean_stress", p);
            const auto truth =
                reference ? at_packing_fraction(reference->history, "mean_stress", p) : std::nullopt;
            stress.back().push_back(number(mean_stress, "{:.3e}"));
            if (mean_stress && truth)
                stress.back().back() += fmt::format(" ({:+.0f} %)", 100.0 * (*mean_stress / *truth - 1.0));
            coordination.back().push_back(number(value_at(result, "coordination_number", p), "{:.2f}"));
        }
        cost.push_back({r.method, fmt::format("{:.2f}", r.wall_time), fmt::format("{:.2f}", r.cpu_time),
                        fmt::format("{}", r.steps), fmt::format("{:.2f}", cost_per_grain_step(r)),
                        fmt::format("{:.2f}", 1e3 * r.cpu_time / static_cast<double>(r.grains)),
                        fmt::format("{:.0f}", r.peak_memory / 1e6)});
        const auto reached =
            result.history ? std::optional(result.history->column("packing_fraction").back()) : std::nullopt;
        endings += fmt::format("- {}: {}, at phi = {}\n", r.method, r.ended, number(reached, "{:.4f}"));
    }
    return fmt::format("{}\n{}\n{}\n{}", markdown_table(stress), markdown_table(coordination),
                       markdown_table(cost), endings);
}

std::string comparison_csv(const std::vector<MethodResult>& results, const std::vector<double>& phi) {
    std::string text =
        "method,packing_fraction,mean_stress,coordination_number,coordination_number_no_rattlers\n";
    for (const MethodResult& result : results)
        for (const double p : phi) {
            if (!value_at(result, "mean_stress", p)) continue;
            text +=
                fmt::format("{},{:.4f},{:.6e},{:.6f},{:.6f}\n", result.report.method, p,
                            *value_at(result, "mean_stress", p), *value_at(result, "coordination_number", p),
                            *value_at(result, "coordination_number_no_rattlers", p));
        }
    return text;
}

}  // namespace softgrain
