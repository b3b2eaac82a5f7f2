#include "app/bench/scaling/scaling_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/bench/rows.hpp"
#include "app/bench/words.hpp"
#include "app/markdown_table.hpp"
#include "app/report/words.hpp"
#include "version.hpp"

namespace softgrain::bench {
namespace {

using Table = std::vector<std::vector<std::string>>;
constexpr const char* none = "-";
constexpr double nano = 1e9, giga = 1e-9;

const char* bound_name(RooflinePoint::Bound bound) {
    switch (bound) {
        case RooflinePoint::Bound::cache:
            return "cache";
        case RooflinePoint::Bound::memory:
            return "memory";
        case RooflinePoint::Bound::arithmetic:
            break;
    }
    return "arithmetic";
}

std::string digits(double value) {
    return fmt::format("{:.3g}", value);
}

std::vector<int> counts_of(const ScalingPlan& plan) {
    std::vector<int> counts;
    for (const Subject& subject : plan.subjects)
        counts.insert(counts.end(), subject.counts.begin(), subject.counts.end());
    std::ranges::sort(counts);
    const auto rest = std::ranges::unique(counts);
    counts.erase(rest.begin(), rest.end());
    return counts;
}

/// A value of each subject with one thread / the least, by number of grains.
template <class Value>
std::string ratios(const ScalingPlan& plan, const ScalingResults& results, Value value) {
    Table table{{"grains"}};
    for (const Subject& subject : plan.subjects) table.front().push_back(subject.name);
    for (const int count : counts_of(plan)) {
        double least = 0.0;
        for (const Subject& subject : plan.subjects)
            if (const ScalingPoint* one = results.find(subject, count, 1))
                least = least > 0.0 ? std::min(least, value(*one)) : value(*one);
        table.push_back({fmt::format("{}", count)});
        for (const Subject& subject : plan.subjects) {
            const ScalingPoint* one = results.find(subject, count, 1);
            table.back().push_back(one && least > 0.0 ? two_digits(value(*one) / least) : none);
        }
    }
    return markdown_table(table);
}

std::string growth(const ScalingResults& results) {
    Table table{{"method", "grains", "threads", "CPU time / fewest grains", "faster than 1 thread",
                 "CPU ns a grain and step", "wall ns", "bytes a grain", "Z", "steps"}};
    const ScalingPoint* first = nullptr;
    for (const ScalingPoint& one : results.points) {
        table.push_back({one.of->name, fmt::format("{}", one.count), fmt::format("{}", one.threads)});
        auto& row = table.back();
        if (one.repeats.empty()) {
            row.insert(row.end(),
                       {none, none, one.failure.empty() ? "not run" : one.failure, none, none, none, none});
            continue;
        }
        if (!first || first->of != one.of) first = &one;
        const ScalingPoint* alone = results.find(*one.of, one.count, 1);
        const StepsReport& report = one.repeats.front();
        row.insert(row.end(),
                   {digits(one.cpu() / first->cpu()),
                    alone ? fmt::format("{:.2f}", alone->wall() / one.wall()) : none,
                    digits(nano * one.cpu()), digits(nano * one.wall()), fmt::format("{:.0f}", one.memory()),
                    fmt::format("{:.2f}", report.coordination_number), fmt::format("{}", report.steps)});
    }
    return markdown_table(table);
}

std::string shares(const ScalingPlan& plan, const ScalingResults& results) {
    std::string text;
    for (const Subject& subject : plan.subjects) {
        const auto profile = results.profiles.find(subject.name);
        if (profile == results.profiles.end()) continue;
        Table table{{fmt::format("{}, {} grains", subject.name, subject.profile_count), "share"}};
        for (const Part& part : parts_of(subject.method, profile->second, plan.kernels))
            table.push_back({part.title, report::percent(part.share)});
        text += markdown_table(table) + "\n";
    }
    for (const auto& [name, reason] : results.unprofiled)
        text += fmt::format("Of {} it was not measured: {}.\n\n", name, reason);
    if (!text.empty()) text.pop_back();
    return text;
}

std::string limits_text(const MachineLimits& limits) {
    const std::string fused =
        limits.fused_flops > 0.0
            ? fmt::format(" (fused, which softgrain does without: {:.0f})", giga * limits.fused_flops)
            : "";
    return fmt::format(
        "One core does {:.0f} Gflop/s in multiplications and additions{}, loads and stores {:.0f} GB/s in "
        "its "
        "first cache and {:.0f} GB/s in memory (triad).\n",
        giga * limits.flops, fused, giga * limits.cache, giga * limits.memory);
}

std::string roofline_table(const std::vector<RooflinePoint>& points) {
    if (points.empty())
        return "No kernel has both a count (kernels.csv beside the plan) and a measured time.\n";
    Table table{{"kernel", "of the limit", "limit is", "Gflop/s", "limit", "share of time", "ns", "flops",
                 "bytes", "from beyond L2", "flops/byte", "flops/byte beyond L2"}};
    for (const RooflinePoint& one : points)
        table.push_back({fmt::format("{}, {}", one.of->name, one.count->title),
                         report::percent(one.rate / one.limit), bound_name(one.bound),
                         digits(giga * one.rate), digits(giga * one.limit), report::percent(one.share),
                         digits(nano * one.time), digits(one.count->flops), digits(one.count->bytes),
                         digits(one.count->far_bytes), digits(one.near_intensity()),
                         one.count->far_bytes > 0.0 ? digits(one.far_intensity()) : none});
    return markdown_table(table);
}

std::string measured_on(const ScalingResults& results) {
    std::vector<double> spread;
    const StepsReport* first = nullptr;
    std::size_t repeats = 0;
    for (const ScalingPoint& one : results.points) {
        if (one.repeats.empty()) continue;
        if (!first) first = &one.repeats.front();
        repeats = std::max(repeats, one.repeats.size());
        spread.push_back(one.spread());
    }
    if (!first) return "No run made its steps.\n";
    return fmt::format(
        "{}, {}; softgrain {} ({}), {}. Each run is a process of its own; times are medians of {}, "
        "interleaved; "
        "the largest CPU time over the least is {:.2f} (median over the runs), at most {:.2f}.\n",
        first->processor, first->finished, first->version, first->commit, compiler, repeats, median(spread),
        std::ranges::max(spread));
}

}  // namespace

std::string scaling_csv(const ScalingResults& results) {
    std::string text =
        "method,grains,threads,warm_up,steps,repeats,cpu_ns_per_grain_step,wall_ns_per_grain_step,"
        "largest_over_least_cpu,bytes_per_grain,coordination_number,failure,keys,machine,compiler,version,"
        "commit,date\n";
    for (const ScalingPoint& one : results.points) {
        text += fmt::format("{},{},{},{}", one.of->name, one.count, one.threads, one.of->warm_up);
        if (one.repeats.empty()) {
            text += fmt::format(",0,0,,,,,,{},{},,{},{},{},\n", quoted(one.failure),
                                quoted(fmt::format("{}", fmt::join(one.of->set, " "))), quoted(compiler),
                                version, commit);
            continue;
        }
        const StepsReport& report = one.repeats.front();
        text += fmt::format(",{},{},{:.5g},{:.5g},{:.3f},{:.1f},{:.4f},{},{},{},{},{},{},{}\n", report.steps,
                            one.repeats.size(), nano * one.cpu(), nano * one.wall(), one.spread(),
                            one.memory(), report.coordination_number, quoted(one.failure),
                            quoted(fmt::format("{}", fmt::join(one.of->set, " "))), quoted(report.processor),
                            quoted(compiler), report.version, report.commit, report.finished);
    }
    return text;
}

std::string roofline_csv(const std::vector<RooflinePoint>& points, const MachineLimits& limits) {
    std::string text = fmt::format(
        "# limits of one core: {:.4g} flop/s, {:.4g} fused, {:.4g} bytes/s in the first cache, {:.4g} in "
        "memory\n"
        "method,kernel,share,ns_per_grain_step,flops,bytes,far_bytes,flops_per_second,limit,bound\n",
        limits.flops, limits.fused_flops, limits.cache, limits.memory);
    for (const RooflinePoint& one : points)
        text += fmt::format("{},{},{:.4f},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{:.5g},{}\n", one.of->name,
                            one.count->title, one.share, nano * one.time, one.count->flops, one.count->bytes,
                            one.count->far_bytes, one.rate, one.limit, bound_name(one.bound));
    return text;
}

std::string scaling_markdown(const ScalingPlan& plan, const ScalingResults& results,
                             const MachineLimits& limits) {
    return fmt::format(
        "# Scaling\n\n{}\n## Beside each other\n\nCPU time of a grain-step with one thread / that of the "
        "cheapest:\n\n"
        "{}\nMemory of a grain / the least:\n\n{}\n## With the number of grains and threads\n\n{}\n"
        "## Where the time goes\n\n{}\n## Distance to the machine's limits\n\n{}\n{}",
        measured_on(results), ratios(plan, results, [](const ScalingPoint& one) { return one.cpu(); }),
        ratios(plan, results, [](const ScalingPoint& one) { return one.memory(); }), growth(results),
        shares(plan, results), limits_text(limits), roofline_table(roofline(plan, results, limits)));
}

}  // namespace softgrain::bench
