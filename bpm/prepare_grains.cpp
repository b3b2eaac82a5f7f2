#include "bpm/prepare_grains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <numeric>
#include <optional>

#include "bpm/aggregate_cache.hpp"
#include "common/at.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

// Area of the discs / area inside the outline that disc_diameter counts on; 0.84 to 0.88 was measured.
constexpr double usual_packing_fraction = 0.86;
constexpr double most_discs = 1e6;  // of one grain

std::vector<Aggregate> prepare_all(const std::vector<AggregateSpec>& specs) {
    std::vector<Aggregate> aggregates(specs.size());
    std::vector<std::exception_ptr> failure(specs.size());
    // The largest grains first: they take longest.
    std::vector<std::size_t> order(specs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t g) { return specs[g].discs; });
#pragma omp parallel for schedule(dynamic)
    for (std::size_t n = 0; n < order.size(); ++n) {
        const std::size_t g = order[n];
        try {
            aggregates[g] = prepare_aggregate(specs[g]);
        } catch (...) {
            failure[g] = std::current_exception();
        }
    }
    for (const std::exception_ptr& error : failure)
        if (error) std::rethrow_exception(error);
    return aggregates;
}

}  // namespace

int discs_in_grain(const BpmSettings& settings, double radius, double mean_radius) {
    double count = settings.discs_per_grain * (radius / mean_radius) * (radius / mean_radius);
    if (settings.disc_diameter) {
        const double disc = *settings.disc_diameter;
        if (disc > 2.0 * radius * (1.0 + 1e-9))
            throw InputError(fmt::format(
                "bpm.disc_diameter: discs of {} m are larger than a grain of {} m; make them smaller", disc,
                2.0 * radius));
        count = usual_packing_fraction * 4.0 * radius * radius /
                (settings.disc_sizes.mean_square_diameter() * disc * disc);
    }
    if (!(count <= most_discs))
        throw InputError(fmt::format(
            "bpm: a grain of radius {} m would have {:.3g} discs (at most {:.0g}); make the discs larger",
            radius, count, most_discs));
    return std::max(1, static_cast<int>(std::lround(count)));
}

std::vector<Aggregate> prepare_grains(const Scenario& scenario, const Packing& packing,
                                      const BpmSettings& settings) {
    const auto grains = static_cast<int>(packing.size());
    const double mean_radius = packing.mean_radius();
    std::vector<AggregateSpec> specs;
    for (int g = 0; g < grains; ++g)
        specs.push_back({.discs = discs_in_grain(settings, packing.radius[at(g)], mean_radius),
                         .sizes = settings.disc_sizes,
                         .attraction_exponent = settings.attraction_exponent,
                         .attraction_range = settings.attraction_range,
                         .outline_rho = settings.outline_rho,
                         .seed = scenario.seed,
                         .grain = g});
    const AggregateCache cache(cache_folder());
    std::optional<std::vector<Aggregate>> kept = cache.find(specs);
    if (!kept) {
        kept = prepare_all(specs);
        cache.keep(specs, *kept);
    }
    for (int g = 0; g < grains; ++g) scale((*kept)[at(g)], packing.radius[at(g)]);
    return std::move(*kept);
}

}  // namespace softgrain::bpm
