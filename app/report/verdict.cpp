#include "app/report/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/report/energy.hpp"
#include "app/report/words.hpp"
#include "common/run_state.hpp"

namespace softgrain::report {
namespace {

constexpr double most_of_the_range = 0.8;  ///< of the truth's, that the nearest method should cover

struct Measured {
    const MethodResult* result;
    CurveError error;
};

/// The nearest first; those that cover most of the range before those that do not.
std::vector<Measured> measured(const std::vector<MethodResult>& results, const Truth& truth) {
    std::vector<Measured> all;
    for (const MethodResult& result : results) {
        if (&result == truth.run || !result.history) continue;
        if (const auto error = curve_error(*result.history, *truth.history)) all.push_back({&result, *error});
    }
    std::ranges::stable_sort(all, [](const Measured& a, const Measured& b) {
        const bool a_most = a.error.share >= most_of_the_range, b_most = b.error.share >= most_of_the_range;
        return a_most != b_most ? a_most : a.error.stress < b.error.stress;
    });
    return all;
}

std::string range_text(const Covered& over) {
    return fmt::format("{} to {}", packing_fraction(over.low), packing_fraction(over.high));
}

std::string no_truth(const std::vector<MethodResult>& results) {
    std::string text =
        "There is nothing to measure against, neither a reference curve nor a run of mpm, so no error is "
        "claimed";
    double high = 1.0, low = 0.0;
    std::vector<const MethodResult*> with_curve;
    for (const MethodResult& result : results)
        if (result.history && result.history->rows() > 1) {
            with_curve.push_back(&result);
            low = std::max(low, covered(*result.history).low);
            high = std::min(high, covered(*result.history).high);
        }
    if (with_curve.size() < 2 || !(high > low)) return text + ".";
    const auto stress = [&](const MethodResult* result) {
        return at_packing_fraction(*result->history, "mean_stress", high).value_or(std::nan(""));
    };
    const auto [least, most] = std::ranges::minmax_element(with_curve, {}, stress);
    return text +
           fmt::format("; at packing fraction {} the mean stress lies between {} N/m ({}) and {} N/m ({}).",
                       packing_fraction(high), significant(stress(*least)), (*least)->report.method,
                       significant(stress(*most)), (*most)->report.method);
}

std::string nearest_sentence(const std::vector<Measured>& all, const Truth& truth) {
    const std::string against =
        truth.run
            ? fmt::format("Against {}, the resolved method among those compared and therefore the reference,",
                          truth.name)
            : fmt::format("Against the given reference {},", truth.name);
    if (all.empty())
        return against + " no error can be given: no other curve has packing fractions in common with it.";
    const auto& [best, error] = all.front();
    std::string text = fmt::format(
        "{} {} {}: its mean stress differs by {} (relative L2) over packing fractions {}, most at {}, "
        "where it is {} {}",
        against, best->report.method, all.size() > 1 ? "is nearest" : "is the one to measure",
        percent(error.stress), range_text(error.over), packing_fraction(error.worst_at),
        percent(std::abs(error.worst)), error.worst < 0.0 ? "lower" : "higher");
    std::vector<std::string> others;
    for (const Measured& other : all)
        if (other.result != best)
            others.push_back(
                fmt::format("{}{} by {}{}", other.result->report.method, others.empty() ? " differs" : "",
                            percent(other.error.stress),
                            other.error.share < most_of_the_range
                                ? fmt::format(" over {} of the range only", percent(other.error.share))
                                : ""));
    if (!others.empty()) text += "; " + listed(others);
    return text + ".";
}

std::string cost_sentence(const std::vector<MethodResult>& results, const MethodResult* about,
                          const Truth* truth) {
    std::vector<const RunReport*> ran;
    for (const MethodResult& result : results)
        if (result.report.steps > 0) ran.push_back(&result.report);
    if (ran.empty()) return "No method made a step.";
    const auto [cheapest, dearest] = std::ranges::minmax_element(ran, {}, &RunReport::cpu_time);
    const RunReport& subject = about ? about->report : **cheapest;
    std::string text = fmt::format("{} took {} of CPU time", subject.method, seconds(subject.cpu_time));
    if (ran.size() == 1) return text + ".";
    std::vector<std::string> beside;
    const auto add = [&](const RunReport& other, std::string_view what) {
        if (&other == &subject || !(other.cpu_time > 0.0) || !(subject.cpu_time > 0.0)) return;
        beside.push_back(fmt::format("{} {} ({}{})", times_less(subject.cpu_time, other.cpu_time),
                                     other.method, what, seconds(other.cpu_time)));
    };
    const RunReport* reference = truth && truth->run ? &truth->run->report : nullptr;
    if (reference) add(*reference, "");
    if (*dearest != reference) add(**dearest, "the most expensive, ");
    if (*cheapest != reference && *cheapest != *dearest) add(**cheapest, "the cheapest, ");
    if (!beside.empty()) text += ", " + listed(beside);
    if (&subject == *cheapest) text += "; nothing was cheaper";
    if (&subject == *dearest) text += "; nothing was more expensive";
    return text + ".";
}

std::string endings_sentence(const std::vector<MethodResult>& results) {
    std::vector<std::string> done, not_done, flagged;
    for (const MethodResult& result : results) {
        const RunReport& report = result.report;
        if (is_complete(report))
            done.push_back(report.method);
        else
            not_done.push_back(
                result.history && result.history->rows() > 0
                    ? fmt::format("{} ended at packing fraction {} ({})", report.method,
                                  packing_fraction(result.history->column("packing_fraction").back()),
                                  report.ended)
                    : fmt::format("{} did not run ({})", report.method, report.ended));
        const auto energy = result.history ? energy_shares(*result.history) : std::nullopt;
        if (energy && energy->is_flagged())
            flagged.push_back(fmt::format("{} of {}", percent(energy->residual), report.method));
    }
    std::string text;
    if (!done.empty())
        text = not_done.empty() && results.size() > 1
                   ? fmt::format("All {} methods did the whole loading", results.size())
                   : fmt::format("{} did the whole loading", listed(done));
    if (!not_done.empty()) text += (text.empty() ? "" : "; ") + listed(not_done);
    if (!flagged.empty())
        text += fmt::format("; the energy residual of the work is {}, more than {}", listed(flagged),
                            whole_percent(most_residual));
    return text + ".";
}

}  // namespace

bool is_complete(const RunReport& report) {
    return report.exit_code == 0 && report.ended == ended_in_order;
}

std::array<std::string, 3> verdict(const std::vector<MethodResult>& results,
                                   const std::optional<Truth>& truth) {
    if (!truth)
        return {no_truth(results), cost_sentence(results, nullptr, nullptr), endings_sentence(results)};
    const auto all = measured(results, *truth);
    return {nearest_sentence(all, *truth),
            cost_sentence(results, all.empty() ? nullptr : all.front().result, &*truth),
            endings_sentence(results)};
}

}  // namespace softgrain::report
