#include "bpm/aggregate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bpm/attraction.hpp"
#include "bpm/disc_sizes.hpp"
#include "bpm/outline.hpp"
#include "bpm/scatter.hpp"
#include "common/contact_dynamics/contact_dynamics.hpp"
#include "common/errors.hpp"
#include "common/stop.hpp"

namespace softgrain::bpm {
namespace {

// Units of the preparation: mean disc diameter 1, F0 1, and a disc of the mean diameter has mass 1.
constexpr double longest_step = 0.1;
constexpr double damping = 0.5;         // rate of the velocity damping
constexpr double start_fraction = 0.4;  // area of the discs / area of the circle they are thrown into
constexpr double pull = 0.3;            // acceleration to the centre at distance 1
constexpr double pull_reach = 6.0;      // it is not stronger beyond: the middle of a large grain would choke
// Three stages: gathered by the pull, calmed with coarse contacts, settled with fine ones.
constexpr double gathered_speed = 0.02, calm_speed = 0.005;
constexpr double gathering = 1e-2, calming = 2e-3, settling = 2e-4;  // tolerance of the contacts / time step
constexpr int settled_steps = 20;  // the bounds must hold for so many steps in a row
constexpr int free_steps = 50;     // and then without damping
constexpr int most_steps = 40000;

ContactSettings contacts_of(double tolerance, int sweeps) {
    return {.tolerance = tolerance,
            .skin = 0.3,
            .max_iterations = sweeps,
            .largest_push = 0.05,
            .heeds_stop = true};
}

double largest_overlap(const ContactDynamics& contacts, std::span<const Vec2> x,
                       std::span<const double> radius) {
    double overlap = 0.0;
    const ContactRows& rows = contacts.rows();
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const auto i = static_cast<std::size_t>(rows.i[k]);
        const auto j = static_cast<std::size_t>(rows.j[k]);
        overlap = std::max(overlap, radius[i] + radius[j] - (x[j] - x[i]).norm());
    }
    return overlap;
}

class Preparation {
  public:
    Preparation(const AggregateSpec& spec, std::vector<double> radius, std::vector<Vec2> x)
        : radius_(std::move(radius)),
          x_(std::move(x)),
          v_(x_.size(), Vec2::Zero()),
          force_(x_.size(), Vec2::Zero()),
          group_(x_.size(), 0),
          attraction_({1.0, spec.attraction_exponent, spec.attraction_range},
                      {0, static_cast<int>(x_.size())}, radius_, 0.5) {
        for (double r : radius_) mass_.push_back(4.0 * r * r);
        time_step_ = longest_step * std::sqrt(governing_mass(mass_));
    }

    /// All three stages; returns the steps made.
    int run() {
        int steps = 0;
        {
            ContactDynamics contacts(contacts_of(gathering * time_step_, 400));
            do {
                step(contacts, pull, damping);
            } while (++steps < most_steps && speed() > gathered_speed);
        }
        {
            ContactDynamics contacts(contacts_of(calming * time_step_, 2000));
            do {
                step(contacts, 0.0, damping);
            } while (++steps < most_steps && speed() > calm_speed);
        }
        ContactDynamics contacts(contacts_of(settling * time_step_, 2000));
        for (int quiet = 0; quiet < settled_steps + free_steps && steps < most_steps; ++steps) {
            step(contacts, 0.0, quiet < settled_steps ? damping : 0.0);
            overlap_ = largest_overlap(contacts, x_, radius_);
            quiet = within_bounds() ? quiet + 1 : 0;
        }
        return steps;
    }

    /// Root mean square.
    double speed() const {
        double sum = 0.0;
        for (const Vec2& v : v_) sum += v.squaredNorm();
        return std::sqrt(sum / static_cast<double>(v_.size()));
    }
    double overlap() const { return overlap_; }
    bool within_bounds() const {
        return speed() < aggregate_speed_bound && overlap_ < aggregate_overlap_bound;
    }

    std::vector<Vec2> about_mass_center() const {
        Vec2 center = Vec2::Zero();
        double mass = 0.0;
        for (std::size_t d = 0; d < x_.size(); ++d) {
            center += mass_[d] * x_[d];
            mass += mass_[d];
        }
        std::vector<Vec2> x = x_;
        for (Vec2& place : x) place -= center / mass;
        return x;
    }
    const std::vector<double>& radius() const { return radius_; }

  private:
    void step(ContactDynamics& contacts, double pull_strength, double damping_rate) {
        heed_stop();
        const bool gathered = pull_strength == 0.0;
        attraction_.forces(x_, 0.0, force_, gathered);
        const double keep = 1.0 - damping_rate * time_step_;
        for (std::size_t d = 0; d < x_.size(); ++d) {
            const double pulled = pull_strength * std::min(1.0, pull_reach / x_[d].norm());
            v_[d] = keep * (v_[d] + time_step_ * (force_[d] / mass_[d] - pulled * x_[d]));
        }
        contacts.solve({x_, radius_, mass_, group_, v_, {}}, walls_, time_step_);
        for (std::size_t d = 0; d < x_.size(); ++d) x_[d] += time_step_ * v_[d];
    }

    std::vector<double> radius_, mass_;
    std::vector<Vec2> x_, v_, force_;
    std::vector<int> group_;
    Attraction attraction_;
    double time_step_ = longest_step;
    double overlap_ = std::numeric_limits<double>::infinity();
    WallMotion walls_{{{-1e9, 1e9, -1e9, 1e9}}, {}};
};

double outline_area(const Aggregate& grain, double rho) {
    std::vector<double> reach = grain.radius;
    for (double& r : reach) r += rho;
    NeighborList near;
    near.build(grain.x, reach, 1e-9);
    return Outline(grain.x, grain.radius, rho, near.pairs()).area();
}

}  // namespace

Aggregate prepare_aggregate(const AggregateSpec& spec) {
    Random random(spec.seed, static_cast<std::uint64_t>(spec.grain));
    std::vector<double> radii = draw_disc_radii(spec.sizes, spec.discs, random);
    std::vector<Vec2> start = scatter_in_circle(radii, start_fraction, random);
    Preparation preparation(spec, std::move(radii), std::move(start));
    Aggregate grain;
    grain.steps = preparation.run();
    grain.speed = preparation.speed();
    grain.overlap = preparation.overlap();
    if (!preparation.within_bounds())
        throw DivergedError(
            spec.grain, "preparation of the aggregate", 0.0,
            fmt::format("after {} steps the speed is {:.3g} sqrt(F0 d/m) (bound {:.3g}) and "
                        "the largest overlap {:.3g} d (bound {:.3g}); use another random.seed",
                        grain.steps, grain.speed, aggregate_speed_bound, grain.overlap,
                        aggregate_overlap_bound));
    grain.x = preparation.about_mass_center();
    grain.radius = preparation.radius();
    scale(grain, std::sqrt(std::numbers::pi / outline_area(grain, spec.outline_rho)));
    for (double r : grain.radius) grain.internal_packing_fraction += r * r;
    return grain;
}

void scale(Aggregate& grain, double factor) {
    for (Vec2& place : grain.x) place *= factor;
    for (double& r : grain.radius) r *= factor;
}

}  // namespace softgrain::bpm
