#include "bpm/calibrate.hpp"

#include <cmath>
#include <exception>

#include "bpm/method.hpp"
#include "bpm/prepare_grains.hpp"
#include "bpm/solver.hpp"
#include "common/errors.hpp"

namespace softgrain::bpm {
namespace {

/// What all forces of a grain scale with.
std::string_view scaled_key(const BpmSettings& settings) {
    return settings.behaviour == GrainBehaviour::plastic ? "attraction_stress" : "bond_stiffness";
}

Scenario with_scale(Scenario scenario, std::string_view key, double value) {
    auto [bpm, is_new] = scenario.method_settings.try_emplace("bpm");
    if (is_new) bpm->second = Settings(method().keys());
    bpm->second.set(key, value);
    return scenario;
}

std::vector<CompressionCurve> compress_grains(const Scenario& scenario, double radius,
                                              const std::vector<std::uint64_t>& seeds) {
    std::vector<CompressionCurve> curves(seeds.size());
    std::vector<std::exception_ptr> failure(seeds.size());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t k = 0; k < seeds.size(); ++k) {
        try {
            curves[k] = compress_grain(scenario, radius, seeds[k]);
        } catch (...) {
            failure[k] = std::current_exception();
        }
    }
    for (const std::exception_ptr& error : failure)
        if (error) std::rethrow_exception(error);
    return curves;
}

Sample property_of(const std::vector<CompressionCurve>& curves, GrainProperty property, double unit) {
    std::vector<double> values;
    for (const CompressionCurve& curve : curves)
        values.push_back((property == GrainProperty::plateau ? curve.plateau : curve.modulus) / unit);
    return sample_of(values);
}

}  // namespace

double Sample::standard_error() const {
    return deviation / std::sqrt(static_cast<double>(count));
}

Sample sample_of(const std::vector<double>& values) {
    Sample sample;
    sample.count = static_cast<int>(values.size());
    for (double value : values) sample.mean += value / sample.count;
    double squares = 0.0;
    for (double value : values) squares += (value - sample.mean) * (value - sample.mean);
    if (sample.count > 1) sample.deviation = std::sqrt(squares / (sample.count - 1));
    return sample;
}

Calibration calibrate(const Scenario& scenario, double radius, GrainProperty property, double asked,
                      int seeds) {
    if (!(asked > 0.0) || !std::isfinite(asked))
        throw InputError("calibrate: the stress or modulus asked for must be > 0");
    if (seeds < 2) throw InputError("calibrate: at least two seeds are needed to know the scatter");
    const BpmSettings settings = settings_of(scenario);
    if (settings.behaviour == GrainBehaviour::brittle)
        throw InputError(
            "calibrate: brittle grains break at bpm.bond_strength, whatever their stiffness; find "
            "bpm.bond_stiffness with `softgrain calibrate --modulus`, --set bpm.grain=elastic and without "
            "bond_strength");
    if (settings.behaviour == GrainBehaviour::elastic && property == GrainProperty::plateau)
        throw InputError(
            "calibrate: elastic grains have no plateau; find bpm.bond_stiffness with `softgrain calibrate "
            "--modulus`");
    std::vector<std::uint64_t> first(static_cast<std::size_t>(seeds)), others(first.size());
    for (std::size_t k = 0; k < first.size(); ++k) {
        first[k] = k + 1;
        others[k] = k + 1 + first.size();
    }
    Calibration result;
    result.asked = asked;
    result.key = scaled_key(settings);
    result.discs = discs_in_grain(settings, radius, radius);
    const double trial = asked;  // any will do; this one is of the right size
    result.measured =
        property_of(compress_grains(with_scale(scenario, result.key, trial), radius, first), property, trial);
    if (!(result.measured.mean > 0.0))
        throw InputError("calibrate: the grains do not resist; use more discs or seeds");
    result.value = asked / result.measured.mean;
    result.check_seeds = others;
    result.check_curves = compress_grains(with_scale(scenario, result.key, result.value), radius, others);
    result.reached = property_of(result.check_curves, property, 1.0);
    return result;
}

}  // namespace softgrain::bpm
