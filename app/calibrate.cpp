#include "app/calibrate.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>

#include "common/errors.hpp"
#include "common/io/atomic_file.hpp"
#include "common/packing/make_packing.hpp"

namespace softgrain {
namespace {

// Figure 6 of Nezamabadi et al. 2017: the aggregates yield at 0.05 E of the elastic grains beside them.
constexpr double yield_per_modulus = 0.05;
constexpr int seeds_of_comparison = 5;
constexpr double wide_error = 0.1;  // standard error / mean that deserves a hint

std::string_view name_of(bpm::GrainProperty property) {
    return property == bpm::GrainProperty::plateau ? "plateau stress" : "initial modulus";
}

std::string curves_csv(const bpm::Calibration& calibration) {
    std::string text = fmt::format(
        "# One grain between two walls, bpm.{} = {:.6g} N/m: stress [N/m] of grains of several "
        "seeds\nstrain,mean",
        calibration.key, calibration.value);
    for (const std::uint64_t seed : calibration.check_seeds) text += fmt::format(",seed_{}", seed);
    text += '\n';
    std::size_t rows = calibration.check_curves.front().strain.size();
    for (const bpm::CompressionCurve& curve : calibration.check_curves)
        rows = std::min(rows, curve.strain.size());
    for (std::size_t k = 0; k < rows; ++k) {
        std::vector<double> stress;
        for (const bpm::CompressionCurve& curve : calibration.check_curves) stress.push_back(curve.stress[k]);
        text += fmt::format("{:.4f},{:.6e}", calibration.check_curves.front().strain[k],
                            bpm::sample_of(stress).mean);
        for (const double s : stress) text += fmt::format(",{:.6e}", s);
        text += '\n';
    }
    return text;
}

}  // namespace

std::string reached_text(const bpm::Calibration& c) {
    return fmt::format("asked {:.4g} N/m, reached {:.3g} +- {:.2g} N/m ({} grains, standard error)", c.asked,
                       c.reached.mean, c.reached.standard_error(), c.reached.count);
}

int calibrate(const CalibrateRequest& request) {
    omp_set_num_threads(request.threads);
    const double radius = make_packing(request.scenario).mean_radius();
    const bpm::Calibration c =
        bpm::calibrate(request.scenario, radius, request.property, request.asked, request.seeds);
    fmt::print("One grain of {} discs, radius {:.4g} m, between two walls\n", c.discs, radius);
    if (request.property == bpm::GrainProperty::plateau)
        fmt::print("{}: mean force / largest section, strain {:.2f} to {:.2f}\n", name_of(request.property),
                   bpm::plateau_begins, bpm::plateau_ends);
    else
        fmt::print(
            "{}: Young's modulus of an elastic disc (Johnson's line contact) with the same secant of force "
            "over "
            "strain, sum(F e) / sum(e^2) up to e = {:.2f}; an aggregate is hardly elastic, this is a scale\n",
            name_of(request.property), bpm::elastic_up_to);
    fmt::print("measured {:.4g} +- {:.2g} {} (seeds 1 to {}, standard error; deviation {:.2g})\n",
               c.measured.mean, c.measured.standard_error(),
               c.key == "attraction_stress" ? "F0/<a0>" : "bond_stiffness", c.measured.count,
               c.measured.deviation);
    fmt::print("checked with seeds {} to {}: {}\n\n[bpm]\n{} = {:.6g}\n", c.check_seeds.front(),
               c.check_seeds.back(), reached_text(c), c.key, c.value);
    if (c.measured.standard_error() > wide_error * c.measured.mean)
        fmt::print("\nThe grains scatter: --seeds {} or more discs in a grain make this more certain.\n",
                   4 * request.seeds);
    if (!request.curve.empty()) write_file_atomically(request.curve, curves_csv(c));
    return 0;
}

double comparable_yield_stress(const Material& material) {
    return material.yield_stress.value_or(yield_per_modulus * material.youngs_modulus);
}

CalibratedScenario with_calibrated_aggregates(const Scenario& scenario, double mean_radius, int threads) {
    CalibratedScenario result{scenario, {}};
    Settings& settings = result.scenario.method_settings.at("bpm");
    if (settings.has("attraction_stress"))
        throw InputError(
            "--calibrate finds bpm.attraction_stress, which the scenario gives already; leave one of them "
            "out");
    omp_set_num_threads(threads);
    const double asked = comparable_yield_stress(scenario.material);
    const bpm::Calibration c =
        bpm::calibrate(scenario, mean_radius, bpm::GrainProperty::plateau, asked, seeds_of_comparison);
    settings.set(c.key, c.value);
    result.scenario.material.yield_stress.reset();  // honoured by the attraction from here on
    result.said = fmt::format(
        "bpm.{} {:.4g} N/m: plateau stress of a grain {}, {}", c.key, c.value,
        scenario.material.yield_stress ? "= material.yield_stress" : fmt::format("= {} E", yield_per_modulus),
        reached_text(c));
    return result;
}

}  // namespace softgrain
