#include <algorithm>

#include "app/bench/scaling/scaling_tables.hpp"

namespace softgrain::bench {
namespace {

bool belongs_to(const std::string& function, const Kernel& kernel) {
    return std::ranges::any_of(
        kernel.functions, [&](const std::string& name) { return function.find(name) != std::string::npos; });
}

double share_of(const KernelCount& count, const std::vector<Part>& parts) {
    if (count.title == whole_step) return 1.0;
    const auto at = std::ranges::find(parts, count.title, &Part::title);
    return at == parts.end() ? 0.0 : at->share;
}

void find_limit(RooflinePoint& point, const MachineLimits& limits) {
    using Bound = RooflinePoint::Bound;
    point.limit = limits.flops;
    point.bound = Bound::arithmetic;
    const auto lower = [&](double flops, Bound bound) {
        if (flops >= point.limit) return;
        point.limit = flops;
        point.bound = bound;
    };
    lower(limits.cache * point.near_intensity(), Bound::cache);
    lower(limits.memory * point.far_intensity(), Bound::memory);
}

}  // namespace

std::vector<Part> parts_of(const std::string& method, const Profile& profile,
                           const std::vector<Kernel>& kernels) {
    std::vector<Part> parts;
    std::vector<const Kernel*> own;
    for (const Kernel& kernel : kernels)
        if (kernel.method == method) {
            own.push_back(&kernel);
            parts.push_back({kernel.title, 0.0});
        }
    double left = 1.0;
    std::vector<Part> functions;
    for (const auto& [function, share] : profile) {
        const auto kernel =
            std::ranges::find_if(own, [&](const Kernel* one) { return belongs_to(function, *one); });
        if (kernel != own.end())
            parts[static_cast<std::size_t>(kernel - own.begin())].share += share;
        else if (share >= least_share)
            functions.push_back({function, share});
        else
            continue;
        left -= share;
    }
    std::ranges::stable_sort(functions, std::greater<>(), &Part::share);
    parts.insert(parts.end(), functions.begin(), functions.end());
    parts.push_back({"others", std::max(0.0, left)});
    return parts;
}

std::vector<RooflinePoint> roofline(const ScalingPlan& plan, const ScalingResults& results,
                                    const MachineLimits& limits) {
    std::vector<RooflinePoint> points;
    for (const Subject& subject : plan.subjects) {
        const ScalingPoint* measured = results.find(subject, subject.profile_count, 1);
        const auto profile = results.profiles.find(subject.name);
        if (!measured) continue;
        const std::vector<Part> parts = profile == results.profiles.end()
                                            ? std::vector<Part>{}
                                            : parts_of(subject.method, profile->second, plan.kernels);
        for (const KernelCount& count : plan.counts) {
            const double share = share_of(count, parts);
            if (count.method != subject.method || share <= 0.0 || count.flops <= 0.0) continue;
            RooflinePoint point{&subject, &count, share, share * measured->cpu(), 0.0, 0.0, {}};
            point.rate = count.flops / point.time;
            find_limit(point, limits);
            points.push_back(point);
        }
    }
    return points;
}

}  // namespace softgrain::bench
