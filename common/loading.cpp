#include "common/loading.hpp"

#include <algorithm>
#include <cmath>

namespace softgrain {
namespace {

constexpr int samples_of_a_hold = 10;
/// Floor of the pressure in an inertial number, in units of the stress scale: below jamming there is no
/// pressure.
constexpr double pressure_floor = 1e-3;

double length(const Box& box, int axis) {
    return axis == 0 ? box.width() : box.height();
}

}  // namespace

StageDriver::StageDriver(const LoadingStage& stage, const Sampling& sampling, const Box& initial,
                         const Box& begin, double undeformed_area)
    : stage_(stage), initial_(initial), begin_(begin) {
    if (is_hold()) {
        end_ = stage_.duration.value();
        interval_ = *end_ / samples_of_a_hold;
        return;
    }
    interval_ = sampling.strain_interval;
    const auto at_most = [&](double progress) {
        end_ = std::min(end_.value_or(progress), std::max(progress, 0.0));
    };
    if (stage_.until_strain) at_most(*stage_.until_strain - axial_strain(begin));
    if (stage_.until_packing_fraction_undeformed) {
        const double target = undeformed_area / *stage_.until_packing_fraction_undeformed;
        const double w = begin.width(), h = begin.height();
        const double w0 = initial.width(), h0 = initial.height();
        if (stage_.kind == LoadingKind::oedometric) {
            const double other = axis() == 0 ? h : w;
            at_most((length(begin, axis()) - target / other) / length(initial, axis()));
        } else {
            // (w - s w0)(h - s h0) = target, smaller root s
            const double a = w0 * h0, b = w * h0 + h * w0, c = w * h - target;
            at_most(2.0 * c / (b + std::sqrt(std::max(0.0, b * b - 4.0 * a * c))));
        }
    }
}

int StageDriver::axis() const {
    return stage_.kind == LoadingKind::oedometric ? wall_axis(static_cast<int>(stage_.wall)) : 0;
}

double StageDriver::axial_strain(const Box& box) const {
    return 1.0 - length(box, axis()) / length(initial_, axis());
}

double StageDriver::progress(const Box& box, double stage_time) const {
    return is_hold() ? stage_time : axial_strain(box) - axial_strain(begin_);
}

double StageDriver::rate(double pressure, double scale, double mean_diameter, double density) const {
    if (is_hold()) return 1.0;
    if (stage_.strain_rate) return *stage_.strain_rate;
    const double p = std::max(pressure, pressure_floor * scale);
    return *stage_.inertial_number / (mean_diameter * std::sqrt(density / p));
}

WallMotion StageDriver::motion(const Box& box, double rate) const {
    WallMotion motion{box, {}};
    if (is_hold()) return motion;
    for (int wall = 0; wall < 4; ++wall) {
        const double shrink = rate * length(initial_, wall_axis(wall));
        auto& velocity = motion.velocity[static_cast<std::size_t>(wall)];
        if (stage_.kind == LoadingKind::isotropic) velocity = 0.5 * wall_sign(wall) * shrink;
        if (stage_.kind == LoadingKind::oedometric && wall == static_cast<int>(stage_.wall))
            velocity = wall_sign(wall) * shrink;
    }
    return motion;
}

bool StageDriver::reached(double packing_fraction, double mean_stress) const {
    return (stage_.until_packing_fraction && packing_fraction >= *stage_.until_packing_fraction) ||
           (stage_.until_stress && mean_stress >= *stage_.until_stress);
}

}  // namespace softgrain
