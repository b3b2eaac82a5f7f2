#include "common/loading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/errors.hpp"

namespace softgrain {
namespace {

constexpr int samples_of_a_hold = 10;
/// Floor of the pressure in an inertial number, in units of the stress scale: below jamming there is no
/// pressure.
constexpr double pressure_floor = 1e-3;
/// Strain by which a stage may already be beyond its end: rounding of accumulated wall positions.
constexpr double rounding = 1e-9;

double length(const Box& box, int axis) {
    return axis == 0 ? box.width() : box.height();
}

/// Largest rate of a velocity gradient [1/s].
double largest(const LoadingStage& stage) {
    return std::max({std::abs(stage.gradient_xx), std::abs(stage.gradient_xy), std::abs(stage.gradient_yy)});
}

}  // namespace

StageDriver::StageDriver(const LoadingStage& stage, int number, const Sampling& sampling, const Box& initial,
                         const Box& begin, double undeformed_area)
    : stage_(stage), initial_(initial), begin_(begin) {
    if (is_timed()) {
        end_ = stage_.duration.value();
        interval_ = stage_.kind == LoadingKind::hold ? *end_ / samples_of_a_hold
                                                     : sampling.strain_interval / largest(stage_);
        return;
    }
    interval_ = sampling.strain_interval;
    const auto at_most = [&](double progress) {
        end_ = std::min(end_.value_or(progress), std::max(progress, 0.0));
    };
    const auto until = [&](std::string_view key, const std::optional<double>& target) {
        if (!target) return;
        const double progress = direction() * (*target - strain(begin));
        if (progress < -rounding)
            throw InputError(
                fmt::format("loading.{}.{} = {} is {} the {:.6g} at which the stage begins; {}", number, key,
                            *target, stage_.reverse ? "above" : "below", strain(begin),
                            stage_.reverse ? "leave out reverse" : "set reverse = true to go back to it"));
        at_most(progress);
    };
    until("until_strain", stage_.until_strain);
    until("until_shear", stage_.until_shear);
    if (stage_.until_packing_fraction_undeformed)
        at_most(direction() * strain_to_undeformed(undeformed_area));
}

double StageDriver::strain_to_undeformed(double undeformed_area) const {
    const double target = undeformed_area / *stage_.until_packing_fraction_undeformed;
    const double w = begin_.width(), h = begin_.height();
    if (stage_.kind == LoadingKind::oedometric) {
        const double other = axis() == 0 ? h : w;
        return (length(begin_, axis()) - target / other) / length(initial_, axis());
    }
    // (w - s w0)(h - s h0) = target, smaller root s
    const double w0 = initial_.width(), h0 = initial_.height();
    const double a = w0 * h0, b = w * h0 + h * w0, c = w * h - target;
    return 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c)));
}

int StageDriver::axis() const {
    return stage_.kind == LoadingKind::oedometric ? wall_axis(static_cast<int>(stage_.wall)) : 0;
}

double StageDriver::axial_strain(const Box& box) const {
    return 1.0 - length(box, axis()) / length(initial_, axis());
}

double StageDriver::strain(const Box& box) const {
    return stage_.kind == LoadingKind::shear ? box.shear_strain() : axial_strain(box);
}

double StageDriver::progress(const Box& box, double stage_time) const {
    return is_timed() ? stage_time : direction() * (strain(box) - strain(begin_));
}

double StageDriver::rate(double pressure, double scale, double mean_diameter, double density) const {
    if (is_timed()) return 1.0;
    if (stage_.strain_rate) return *stage_.strain_rate;
    const double p = std::max(pressure, pressure_floor * scale);
    return *stage_.inertial_number / (mean_diameter * std::sqrt(density / p));
}

double StageDriver::strain_rate(double rate) const {
    if (stage_.kind == LoadingKind::hold) return 0.0;
    return stage_.kind == LoadingKind::gradient ? largest(stage_) : rate;
}

WallMotion StageDriver::motion(const Box& box, double rate, double dt) const {
    WallMotion motion{box, {}, 0.0};
    if (stage_.kind == LoadingKind::hold) return motion;
    if (stage_.kind == LoadingKind::gradient) return gradient_motion(box, dt);
    if (stage_.kind == LoadingKind::shear) {
        motion.tilt_rate = direction() * rate * box.height();
        return motion;
    }
    for (int wall = 0; wall < 4; ++wall) {
        const double shrink = direction() * rate * length(initial_, wall_axis(wall));
        auto& velocity = motion.velocity[static_cast<std::size_t>(wall)];
        if (stage_.kind == LoadingKind::isotropic) velocity = 0.5 * wall_sign(wall) * shrink;
        if (stage_.kind == LoadingKind::oedometric && wall == static_cast<int>(stage_.wall))
            velocity = wall_sign(wall) * shrink;
    }
    // No shear: the second lattice vector is stretched as the first is.
    motion.tilt_rate = motion.width_rate() / box.width() * box.tilt;
    return motion;
}

/// The lattice follows dH/dt = L H exactly over the step, about a middle that stays.
WallMotion StageDriver::gradient_motion(const Box& box, double dt) const {
    const double xx = stage_.gradient_xx * dt, yy = stage_.gradient_yy * dt;
    const double difference = yy - xx;
    // (e^yy - e^xx) / (yy - xx)
    const double mixed =
        std::exp(xx) * (std::abs(difference) > 0.0 ? std::expm1(difference) / difference : 1.0);
    const double x = 0.5 * box.width() * std::expm1(xx) / dt;
    const double y = 0.5 * box.height() * std::expm1(yy) / dt;
    return {box, {-x, x, -y, y}, box.tilt * std::expm1(xx) / dt + stage_.gradient_xy * box.height() * mixed};
}

bool StageDriver::reached(double packing_fraction, double mean_stress) const {
    const auto beyond = [&](double value, const std::optional<double>& target) {
        return target && direction() * (value - *target) >= 0.0;
    };
    return beyond(packing_fraction, stage_.until_packing_fraction) ||
           beyond(mean_stress, stage_.until_stress);
}

}  // namespace softgrain
