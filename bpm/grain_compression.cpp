#include "bpm/grain_compression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bpm/solver.hpp"
#include "common/errors.hpp"
#include "common/stop.hpp"

namespace softgrain::bpm {
namespace {

constexpr double interval = 0.005;  // of strain
constexpr std::size_t least_discs = 10;
constexpr double side_walls = 3.0;  // distance of the side walls from the centre [radii]

Packing lone_grain(double radius) {
    Packing packing;
    packing.box.position = {-side_walls * radius, side_walls * radius, -2.0 * radius, 2.0 * radius};
    packing.center.push_back(Vec2::Zero());
    packing.radius.push_back(radius);
    return packing;
}

/// Sums over the steps of a run.
class Measurement {
  public:
    void add(double strain, double force, double stress) {
        const auto k = static_cast<std::size_t>(strain / interval);
        if (k >= sum_.size()) {
            sum_.resize(k + 1, 0.0);
            steps_.resize(k + 1, 0);
        }
        sum_[k] += stress;
        ++steps_[k];
        if (strain < elastic_up_to) {
            force_by_strain_ += force * strain;
            strain_squared_ += strain * strain;
        }
        if (strain >= plateau_begins) {
            plateau_ += stress;
            ++plateau_steps_;
        }
    }
    double plateau() const { return plateau_ / plateau_steps_; }
    double secant() const { return force_by_strain_ / strain_squared_; }
    void give_curve(CompressionCurve& curve) const {
        for (std::size_t k = 0; k < sum_.size(); ++k) {
            if (steps_[k] == 0) continue;
            curve.strain.push_back((static_cast<double>(k) + 0.5) * interval);
            curve.stress.push_back(sum_[k] / steps_[k]);
        }
    }

  private:
    std::vector<double> sum_;
    std::vector<int> steps_;
    double force_by_strain_ = 0.0, strain_squared_ = 0.0, plateau_ = 0.0;
    int plateau_steps_ = 0;
};

}  // namespace

Extent extent_of_discs(const BpmSolver& solver, int axis) {
    Extent e{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t d = 0; d < solver.disc_position().size(); ++d) {
        e.low = std::min(e.low, solver.disc_position()[d][axis] - solver.disc_radius()[d]);
        e.high = std::max(e.high, solver.disc_position()[d][axis] + solver.disc_radius()[d]);
    }
    return e;
}

double johnson_modulus(double force, double strain, double radius) {
    // With f = F/(pi E* R) and half contact width a = 2 R sqrt(f): strain = f (2 ln(4R/a) - 1).
    double f = strain / 6.0;
    for (int k = 0; k < 100; ++k) {
        const double next = strain / (std::log(4.0 / f) - 1.0);
        if (std::abs(next - f) < 1e-15 * f) break;
        f = next;
    }
    return force / (std::numbers::pi * f * radius);
}

CompressionCurve compress_grain(const Scenario& scenario, double radius, std::uint64_t seed) {
    Scenario own = scenario;
    own.seed = seed;
    const Packing packing = lone_grain(radius);
    BpmSolver solver(own, packing);
    const std::size_t discs = solver.disc_position().size();
    if (discs < least_discs)
        throw InputError(
            fmt::format("a grain of {} discs has no plateau; give it at least {} (bpm.discs_per_grain)",
                        discs, least_discs));

    const Extent height_of_grain = extent_of_discs(solver, 1);
    const double height = height_of_grain.length();
    Box box = packing.box;
    box.position[2] = height_of_grain.low;
    box.position[3] = height_of_grain.high;
    const double disc_mass =
        own.material.density * std::numbers::pi * radius * radius / static_cast<double>(discs);
    const double speed =
        compression_speed * std::sqrt(solver.maximum_force() * solver.mean_disc_diameter() / disc_mass);
    Measurement measured;
    while (box.height() > (1.0 - plateau_ends) * height) {
        heed_stop();
        const double h = solver.stable_time_step();
        const WallMotion walls{box, {0.0, 0.0, 0.5 * speed, -0.5 * speed}};
        solver.advance(walls, h);
        box = walls.after(h);
        if (const auto reason = solver.outside_validity())
            throw DivergedError(-1, "grain between two walls", solver.view(Need::base).time,
                                fmt::format("prepared from seed {}: {}", seed, *reason));
        const double force = 0.5 * (solver.wall_force()[3].y() - solver.wall_force()[2].y());
        measured.add(1.0 - box.height() / height, force, force / extent_of_discs(solver, 0).length());
    }
    solver.check_finite();
    CompressionCurve curve;
    measured.give_curve(curve);
    curve.plateau = measured.plateau();
    const double nu = own.material.poisson_ratio;
    curve.modulus =
        (1.0 - nu * nu) * johnson_modulus(measured.secant() * elastic_up_to, elastic_up_to, 0.5 * height);
    return curve;
}

}  // namespace softgrain::bpm
