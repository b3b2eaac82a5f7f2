#include "app/bench/choice.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace softgrain::bench {
namespace {

/// Least known error of a method on a case; none if no row of it is eligible.
std::optional<double> least_error(const CaseRows& one, const std::string& method) {
    std::optional<double> least;
    for (const Row& row : one.rows)
        if (row.setting->method == method && is_eligible(row))
            least = std::min(least.value_or(std::numeric_limits<double>::infinity()), one.known_error(row));
    return least;
}

/// A setting over all cases where its method has an eligible row.
struct Overall {
    const Setting* setting;
    double worst;    ///< largest ratio of its error to the method's least
    double log_cpu;  ///< mean logarithm of CPU time
};

/// None if the setting is not eligible on one of the cases.
std::optional<Overall> overall(const std::vector<CaseRows>& cases, const Setting& setting) {
    Overall all{&setting, 0.0, 0.0};
    int count = 0;
    for (const CaseRows& one : cases) {
        const auto least = least_error(one, setting.method);
        if (!least) continue;
        const Row* row = row_of(one, setting);
        if (!row || !is_eligible(*row)) return std::nullopt;
        all.worst = std::max(all.worst, one.known_error(*row) / *least);
        all.log_cpu += std::log(row->cost.cpu);
        ++count;
    }
    all.log_cpu /= count;
    return count > 0 ? std::optional(all) : std::nullopt;
}

}  // namespace

std::vector<std::size_t> pareto_front(const CaseRows& one) {
    std::vector<std::size_t> order(one.rows.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::erase_if(order, [&](std::size_t k) { return !is_eligible(one.rows[k]); });
    std::ranges::stable_sort(order, [&](std::size_t a, std::size_t b) {
        const Row &left = one.rows[a], &right = one.rows[b];
        if (left.cost.cpu != right.cost.cpu) return left.cost.cpu < right.cost.cpu;
        return one.known_error(left) < one.known_error(right);
    });
    std::vector<std::size_t> front;
    for (const std::size_t k : order)
        if (front.empty() || one.known_error(one.rows[k]) < one.known_error(one.rows[front.back()]))
            front.push_back(k);
    return front;
}

const Row* cheapest(const CaseRows& one, double most_error, const std::string& method) {
    const Row* best = nullptr;
    for (const Row& row : one.rows) {
        if (!method.empty() && row.setting->method != method) continue;
        if (!is_eligible(row) || one.known_error(row) > most_error) continue;
        if (!best || row.cost.cpu < best->cost.cpu) best = &row;
    }
    return best;
}

const Setting* recommended(const std::vector<CaseRows>& cases, const std::string& method) {
    std::vector<Overall> all;
    for (const CaseRows& one : cases)
        for (const Row& row : one.rows)
            if (row.setting->method == method)
                if (const auto own = overall(cases, *row.setting)) all.push_back(*own);
    if (all.empty()) return nullptr;
    const double least = std::ranges::min(all, {}, &Overall::worst).worst;
    std::erase_if(all, [&](const Overall& one) { return one.worst > worse_by * least; });
    return std::ranges::min(all, {}, &Overall::log_cpu).setting;
}

const Row* row_of(const CaseRows& one, const Setting& setting) {
    const auto at = std::ranges::find(one.rows, &setting, &Row::setting);
    return at == one.rows.end() ? nullptr : &*at;
}

std::optional<Ratio> ratio_of(const Headline& headline, const std::vector<CaseRows>& cases) {
    for (const CaseRows& one : cases) {
        if (one.of->name != headline.case_name) continue;
        const Row* cheap = cheapest(one, headline.error, headline.method);
        const Row* dear = nullptr;
        for (const Row& row : one.rows)
            if (row.setting->knob == headline.against && is_eligible(row)) dear = &row;
        if (cheap && dear) return Ratio{cheap, dear, dear->cost.cpu / cheap->cost.cpu};
    }
    return std::nullopt;
}

}  // namespace softgrain::bench
