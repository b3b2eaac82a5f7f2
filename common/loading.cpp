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

/// A servo beside a driven axis may be this much faster: dilating grains need more than a constant area.
constexpr double servo_haste = 3.0;

double length(const Box& box, int axis) {
    return axis == 0 ? box.width() : box.height();
}

/// Largest rate of a velocity gradient [1/s].
double largest(const LoadingStage& stage) {
    return std::max({std::abs(stage.gradient_xx), std::abs(stage.gradient_xy), std::abs(stage.gradient_yy)});
}

/// Half the difference of the principal stresses / the mean stress; 0 without stress.
double stress_ratio(const Mat2& s) {
    const double mean = 0.5 * s.trace();
    return mean > 0.0 ? std::hypot(0.5 * (s(0, 0) - s(1, 1)), s(0, 1)) / mean : 0.0;
}

}  // namespace

StageDriver::StageDriver(const LoadingStage& stage, std::size_t number, const Sampling& sampling,
                         const Box& initial, const StageBegin& begin, const Grains& grains)
    : stage_(stage),
      number_(number),
      initial_(initial),
      begin_(begin.box),
      grains_(grains),
      plan_(plan_of(stage, begin.stress)) {
    if (plan_.has_servo()) {
        for (const auto& target : plan_.target)
            if (target && *target <= 0.0)
                throw InputError(
                    fmt::format("loading.{} goes to a stress of {:.4g}, and a packing cannot pull; make its "
                                "amplitude smaller",
                                number, *target));
        // Where only the servo strains the packing its stress tells how stiff it is.
        servo_.emplace(plan_.target, initial, grains.density, grains.mean_diameter, stage.seeks_stress());
    }
    interval_ = sampling.strain_interval;
    if (is_timed()) {
        end_ = stage_.duration.value();
        interval_ = stage_.kind == LoadingKind::hold
                        ? sampling.time_interval.value_or(*end_ / samples_of_a_hold)
                        : sampling.strain_interval / largest(stage_);
        return;
    }
    find_end();
}

void StageDriver::find_end() {
    const auto at_most = [&](double progress) {
        end_ = std::min(end_.value_or(progress), std::max(progress, 0.0));
    };
    const auto until = [&](std::string_view key, const std::optional<double>& target) {
        if (!target) return;
        const double progress = direction() * (*target - strain(begin_));
        if (progress < -rounding)
            throw InputError(
                fmt::format("loading.{}.{} = {} is {} the {:.6g} at which the stage begins; {}", number_, key,
                            *target, stage_.reverse ? "above" : "below", strain(begin_),
                            stage_.reverse ? "leave out reverse" : "set reverse = true to go back to it"));
        at_most(progress);
    };
    until("until_strain", stage_.until_strain);
    until("until_shear", stage_.until_shear);
    if (stage_.strain_amplitude) at_most(*stage_.strain_amplitude);
    if (stage_.until_packing_fraction_undeformed && !plan_.has_servo())
        at_most(direction() * strain_to_undeformed());
}

double StageDriver::strain_to_undeformed() const {
    const double target = grains_.undeformed_area / *stage_.until_packing_fraction_undeformed;
    const double w = begin_.width(), h = begin_.height();
    if (plan_.share[static_cast<std::size_t>(1 - plan_.axis)] == 0.0) {
        const double other = plan_.axis == 0 ? h : w;
        return (length(begin_, plan_.axis) - target / other) / length(initial_, plan_.axis);
    }
    // (w - s w0)(h - s h0) = target, smaller root s
    const double w0 = initial_.width(), h0 = initial_.height();
    const double a = w0 * h0, b = w * h0 + h * w0, c = w * h - target;
    return 2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c)));
}

double StageDriver::axial_strain(const Box& box) const {
    return 1.0 - length(box, plan_.axis) / length(initial_, plan_.axis);
}

double StageDriver::strain(const Box& box) const {
    if (plan_.progress == ProgressMeasure::shear_strain) return box.shear_strain();
    if (plan_.progress != ProgressMeasure::strain_path) return axial_strain(box);
    return plan_.share[0] * (1.0 - box.width() / initial_.width()) +
           plan_.share[1] * (1.0 - box.height() / initial_.height());
}

double StageDriver::progress(const Box& box, double stage_time, double most_strain) const {
    if (plan_.progress == ProgressMeasure::most_strain) return most_strain;
    return is_timed() ? stage_time : direction() * (strain(box) - strain(begin_));
}

std::optional<double> StageDriver::end_time() const {
    return is_timed() ? std::nullopt : stage_.duration;
}

double StageDriver::rate(double pressure) const {
    if (is_timed()) return 1.0;
    if (stage_.strain_rate) return *stage_.strain_rate;
    double floor = pressure_floor * grains_.stress_scale;
    if (plan_.has_servo()) {
        const auto& [x, y] = plan_.target;
        floor = x && y ? 0.5 * (*x + *y) : x ? *x : *y;
    }
    const double p = std::max(pressure, floor);
    return stage_.inertial_number.value() / (grains_.mean_diameter * std::sqrt(grains_.density / p));
}

double StageDriver::servo_limit(double rate) const {
    return stage_.seeks_stress() ? rate : servo_haste * rate;
}

double StageDriver::strain_rate(double rate, const ServoState& servo) const {
    if (stage_.kind == LoadingKind::hold) return 0.0;
    if (plan_.progress == ProgressMeasure::most_strain)
        return std::max(std::abs(servo.rate[0]), std::abs(servo.rate[1]));
    return stage_.kind == LoadingKind::gradient ? largest(stage_) : rate;
}

WallMotion StageDriver::motion(const Box& box, double rate, const ServoState& servo, double dt) const {
    WallMotion motion{box, {}, 0.0};
    if (stage_.kind == LoadingKind::hold) return motion;
    if (stage_.kind == LoadingKind::gradient) return gradient_motion(box, dt);
    for (int wall = 0; wall < 4; ++wall) {
        const int axis = wall_axis(wall);
        const auto a = static_cast<std::size_t>(axis);
        if (plan_.only_wall && wall != static_cast<int>(*plan_.only_wall)) continue;
        if (!plan_.target[a] && plan_.share[a] == 0.0) continue;
        const double strain_rate = plan_.target[a] ? servo.rate[a] : direction() * rate * plan_.share[a];
        const double shrink = strain_rate * length(initial_, axis);
        motion.velocity[static_cast<std::size_t>(wall)] =
            (plan_.only_wall ? 1.0 : 0.5) * wall_sign(wall) * shrink;
    }
    motion.tilt_rate = tilt_rate(motion, rate, dt);
    return motion;
}

double StageDriver::tilt_rate(const WallMotion& motion, double rate, double dt) const {
    const Box& box = motion.box;
    // No shear: the second lattice vector is stretched as the first is.
    if (plan_.shear == 0.0) return motion.width_rate() / box.width() * box.tilt;
    const double shear = direction() * rate * plan_.shear;
    if (!plan_.has_servo()) return shear * box.height();
    // tilt / height grows by shear * dt, whatever the height does.
    return shear * (box.height() + motion.height_rate() * dt) + box.shear_strain() * motion.height_rate();
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

bool StageDriver::reached(const Answer& answer, const Box& box, const ServoState& servo) const {
    const auto beyond = [&](double value, const std::optional<double>& target) {
        return target && direction() * (value - *target) >= 0.0;
    };
    if (beyond(answer.packing_fraction, stage_.until_packing_fraction) ||
        beyond(0.5 * answer.stress.trace(), stage_.until_stress) ||
        beyond(answer.stress(0, 0), stage_.until_stress_xx) ||
        beyond(answer.stress(1, 1), stage_.until_stress_yy) ||
        beyond(stress_ratio(answer.stress), stage_.until_stress_ratio))
        return true;
    if (plan_.has_servo() &&
        beyond(grains_.undeformed_area / box.area(), stage_.until_packing_fraction_undeformed))
        return true;
    if (!wants_unbalanced()) return false;
    const bool balanced = answer.unbalanced <= stage_.until_unbalanced.value_or(packing_at_rest);
    return stage_.seeks_stress() ? balanced && at_stress(answer, servo) : balanced;
}

bool StageDriver::at_stress(const Answer& answer, const ServoState& servo) const {
    for (int axis = 0; axis < 2; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        if (!plan_.target[a]) continue;
        const auto near = [&](double stress) { return std::abs(stress - *plan_.target[a]) <= plan_.band[a]; };
        if (!near(servo.stress[a]) || !near(answer.stress(axis, axis))) return false;
    }
    return true;
}

}  // namespace softgrain
