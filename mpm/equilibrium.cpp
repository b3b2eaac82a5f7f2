#include "mpm/equilibrium.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/stop.hpp"
#include "mpm/contact/model_search.hpp"

namespace softgrain::mpm {
namespace {

/// Spring that holds every node: grains without contact have no other [largest modulus].
constexpr double least_hold = 1e-9, most_hold = 1e4;
constexpr double hold_down = 0.1;
/// Share of the decrease foreseen that a step must bring.
constexpr double sufficient = 1e-4;
constexpr int most_halvings_of_search = 6;
/// Most looks at which points a step makes touch.
constexpr int most_looks = 12;
/// Friction that changes by less has been foreseen [largest force of a node].
constexpr double same_friction = 1e-3;
/// Largest motion of a node in an iteration [smallest radius].
constexpr double longest_step = 0.3;
/// Energies are not compared closer than this [energy].
constexpr double rounding_of_energy = 1e-13;
/// Energies that differ by less are equal if forces say so [energy].
constexpr double blur_of_energy = 1e-9;
/// Floor of the force that residuals are compared with [modulus * grid spacing].
constexpr double least_force = 1e-5;
constexpr std::size_t worth_threads = 2;  // grains

/// Of the components of forces.
struct Largest {
    double size = 0.0;
    int node = 0;
};
Largest largest_of(std::span<const Vec2> force) {
    Largest largest;
    for (std::size_t m = 0; m < force.size(); ++m) {
        const double f = force[m].cwiseAbs().maxCoeff();
        if (f > largest.size) largest = {f, static_cast<int>(m)};
    }
    return largest;
}

}  // namespace

Equilibrium::Equilibrium(Grains& grains, const EquilibriumSettings& settings,
                         std::unique_ptr<LinearSolver> linear)
    : grains_(grains),
      threads_(grains.size() >= worth_threads ? omp_get_max_threads() : 1),
      settings_(settings),
      linear_(std::move(linear)),
      work_(static_cast<std::size_t>(omp_get_max_threads()),
            GrainForces(*grains.disc, *grains.pattern, settings.mean_dilatation)),
      mass_(*grains.disc, *grains.pattern),
      contacts_(grains, settings.penalty),

      friction_(grains, settings.friction, settings.wall_friction),
      model_(grains),
      radius_(std::numeric_limits<double>::infinity()) {
    for (const Grain& grain : grains_.grain) {
        modulus_ = std::max(modulus_, grain.modulus);
        radius_ = std::min(radius_, grain.radius);
    }
    step_.resize(grains_.all_nodes());
    looked_.resize(grains_.all_nodes());
    pushes_.resize(grains_.all_nodes());
    for (Trial* trial : {&trial_, &farther_}) {
        trial->q.resize(grains_.all_nodes());
        trial->force.resize(grains_.all_nodes());
    }
}

void Equilibrium::set_inertia(std::span<const Vec2> to, double dt) {
    drift_.assign(to.begin(), to.end());
    per_dt2_ = 1.0 / (dt * dt);
}

double Equilibrium::evaluate(std::span<const Vec2> q, const Box& box, std::span<Vec2> force) {
    const std::size_t nodes = grains_.nodes();
    std::vector<double> energy(grains_.size()), largest(grains_.size(), 0.0), height(grains_.size(), 0.0);
    const bool falls = !settings_.gravity.isZero();
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        GrainForces& work = work_[static_cast<std::size_t>(omp_get_thread_num())];
        const std::span<Vec2> own = force.subspan(g * nodes, nodes);
        std::fill(own.begin(), own.end(), Vec2::Zero());
        energy[g] = work.evaluate(grains_.grain[g], q.subspan(g * nodes, nodes),
                                  grains_.of_points(plastic, g), own, {});
        for (const Vec2& f : own) largest[g] = std::max(largest[g], f.cwiseAbs().maxCoeff());
        if (per_dt2_ > 0.0) height[g] += add_inertia(g, q, own);
        for (std::size_t m = 0; falls && m < nodes; ++m) {
            const Vec2 weight = grains_.mass_of_node(g, m) * settings_.gravity;
            height[g] -= weight.dot(q[g * nodes + m]);
            own[m] -= weight;
        }
    }
    elastic_ = force_scale_ = 0.0;
    double potential = 0.0;
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        elastic_ += energy[g];
        potential += height[g];
        const Grain& grain = grains_.grain[g];
        const double floor = least_force * grain.modulus * grain.radius * grains_.disc->spacing();
        force_scale_ = std::max({force_scale_, largest[g], floor});
    }
    if (!std::isfinite(elastic_)) return elastic_;
    surfaces_.update(grains_, q);
    elastic_ += contacts_.evaluate(surfaces_, box, force);
    return elastic_ + potential + friction_.evaluate(surfaces_, force);
}

void Equilibrium::begin_slip(std::span<const Vec2> q, const Box& box, std::span<Vec2> force) {
    evaluate(q, box, force);
    if (!friction_.exists()) return;
    friction_.begin(surfaces_);
    friction_.lag(contacts_);
    evaluate(q, box, force);
}

std::array<Vec2, 4> Equilibrium::wall_force() const {
    std::array<Vec2, 4> sum = contacts_.wall_force();
    for (std::size_t w = 0; w < sum.size(); ++w) sum[w] += friction_.wall_force()[w];
    return sum;
}

/// Energy; adds its derivative to that of the nodes of a grain.
double Equilibrium::add_inertia(std::size_t g, std::span<const Vec2> q, std::span<Vec2> own) const {
    const std::size_t nodes = grains_.nodes();
    std::vector<Vec2> away(nodes), pull(nodes);
    for (std::size_t m = 0; m < nodes; ++m) away[m] = q[g * nodes + m] - drift_[g * nodes + m];
    mass_.apply(away, pull);
    const double scale = grains_.grain[g].density * grains_.grain[g].area * per_dt2_;
    double energy = 0.0;
    for (std::size_t m = 0; m < nodes; ++m) {
        own[m] += scale * pull[m];
        energy += 0.5 * scale * away[m].dot(pull[m]);
    }
    return energy;
}

void Equilibrium::find_grain_stiffness(std::span<const Vec2> q) {
    const std::size_t nodes = grains_.nodes(), places = grains_.pattern->size();
    stiffness_.grain.resize(grains_.size() * places);
#pragma omp parallel if (grains_.threads)
    {
        std::vector<Vec2> unused(nodes, Vec2::Zero());
#pragma omp for schedule(static)
        for (std::size_t g = 0; g < grains_.size(); ++g) {
            const std::span<Mat2> own{stiffness_.grain.data() + g * places, places};
            work_[static_cast<std::size_t>(omp_get_thread_num())].evaluate(
                grains_.grain[g], q.subspan(g * nodes, nodes), grains_.of_points(plastic, g), unused, own);
            const double scale = grains_.grain[g].density * grains_.grain[g].area * per_dt2_;
            for (std::size_t k = 0; scale > 0.0 && k < places; ++k)
                own[k].diagonal().array() += scale * mass_.in_pattern()[k];
        }
    }
}

bool Equilibrium::find_step(std::span<const Vec2> q, std::span<const Vec2> force, EquilibriumResult& result) {
    find_grain_stiffness(q);
    model_.build(contacts_, friction_.sliders());
    model_.find_active({}, active_);
    model_.find_stiffness(active_, stiffness_.contact);
    // What pulls the nodes without contacts: those of the model take their place.
    std::vector<Vec2> alone(force.size(), Vec2::Zero());
    model_.add_force(active_, alone);
    for (std::size_t m = 0; m < force.size(); ++m) alone[m] = -alone[m] - force[m];
    for (double hold = least_hold;; hold *= hold_up) {
        stiffness_.shift = modulus_ * hold;
        if (linear_->factor_grains(stiffness_)) break;
        if (hold > most_hold) {
            result.why = "a grain has no stiffness left";
            return false;
        }
    }
    linear_->begin(alone);
    ModelSearch search(model_);
    std::vector<Touch> factored;
    std::vector<ContactSpring> changes;
    for (int look = 1;; ++look) {
        heed_stop();
        model_.find_changes(factored.empty() ? active_ : factored, active_, changes);
        const bool kept = look > 1 && linear_->change_contacts(changes);
        if (!kept && look > 1) model_.find_stiffness(active_, stiffness_.contact);
        if (!kept) factored = active_;
        while (!kept) {
            stiffness_.contact_shift = modulus_ * hold_;
            ++result.factorizations;
            if (linear_->factor_contacts(stiffness_)) break;
            if (hold_ > most_hold) {
                result.why = "the contacts have no stiffness left";
                return false;
            }
            hold_more();
        }
        std::fill(pushes_.begin(), pushes_.end(), Vec2::Zero());
        model_.add_force(active_, pushes_);
        linear_->solve_contacts(pushes_, looked_);
        const double share = search.approach(looked_, active_);
        if (share == 1.0)
            step_.swap(looked_);
        else
            for (std::size_t m = 0; m < step_.size(); ++m) step_[m] += share * (looked_[m] - step_[m]);
        next_active_ = search.touches();
        bool seen = share == 1.0 && next_active_ == active_;
        if (seen && friction_.exists() &&
            model_.bound_friction(search.moved()) > same_friction * force_scale_) {
            seen = false;
            next_active_ = search.touches();
        }
        if (seen || look == most_looks) break;
        active_.swap(next_active_);
    }
    linear_->finish(step_);
    return true;
}

void Equilibrium::try_step(std::span<const Vec2> q, double share, const Box& box, Trial& trial) {
    for (std::size_t m = 0; m < q.size(); ++m) trial.q[m] = q[m] + share * step_[m];
    trial.energy = evaluate(trial.q, box, trial.force);
}

EquilibriumResult Equilibrium::find(std::vector<Vec2>& q, const Box& box) {
    EquilibriumResult result;
    std::vector<Vec2> force(q.size());
    double energy = evaluate(q, box, force);
    if (friction_.exists()) friction_.begin(surfaces_);
    hold_ = 0.0;
    for (;; ++result.iterations) {
        heed_stop();
        if (friction_.exists()) {
            friction_.lag(contacts_);
            energy = evaluate(q, box, force);
        }
        const Largest largest = largest_of(force);
        result.worst_node = largest.node;
        result.residual = largest.size / force_scale_;
        if (!std::isfinite(energy)) {
            result.why = "a grain is inside out";
            return result;
        }
        result.converged = result.residual <= settings_.tolerance;
        if (result.converged) return result;
        if (result.iterations == settings_.most_iterations) {
            result.why = fmt::format("{} iterations leave {:.2g} of the largest force", result.iterations,
                                     result.residual);
            return result;
        }
        grains_.threads = threads_.parallel();
        const double begun = omp_get_wtime();
        if (!find_step(q, force, result)) return result;
        threads_.note(omp_get_wtime() - begun);
        if (friction_.exists()) {
            friction_.bound(model_.most());
            energy = evaluate(q, box, force);
        }

        double longest = 0.0, slope = 0.0;
        for (std::size_t m = 0; m < q.size(); ++m) {
            longest = std::max(longest, step_[m].norm());
            slope -= step_[m].dot(force[m]);
        }
        const double whole = std::min(1.0, longest_step * radius_ / longest);
        const double tiny = rounding_of_energy * std::abs(energy);
        // Near the solution the energy no longer tells, but forces do.
        const auto better = [&](double share) {
            return trial_.energy <= energy - sufficient * share * slope + tiny ||
                   (std::abs(trial_.energy - energy) < blur_of_energy * std::abs(energy) &&
                    largest_of(trial_.force).size < largest.size);
        };
        double share = whole;
        bool found = false;
        for (int halving = 0; halving <= most_halvings_of_search && !found; ++halving) {
            if (halving > 0) share *= 0.5;
            try_step(q, share, box, trial_);
            found = better(share);
        }
        if (!found) {
            hold_more();
            energy = evaluate(q, box, force);
            continue;
        }
        const double got = energy - trial_.energy, foreseen = share * (1.0 - 0.5 * share) * slope;
        bool last_is_best = true;
        for (double far = 2.0 * share;
             last_is_best && got > foreseen && far * longest < longest_step * radius_; far *= 2.0) {
            try_step(q, far, box, farther_);
            last_is_best = farther_.energy < trial_.energy;
            if (last_is_best) std::swap(trial_, farther_);
        }
        if (!last_is_best) evaluate(trial_.q, box, trial_.force);
        if (share == whole && got > 0.5 * foreseen)
            hold_ = hold_ * hold_down < first_hold ? 0.0 : hold_ * hold_down;
        else if (share < 0.5 * whole)
            hold_more();
        q.swap(trial_.q);
        force.swap(trial_.force);
        energy = trial_.energy;
    }
}

}  // namespace softgrain::mpm
