#include "bpm/solver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "bpm/prepare_grains.hpp"
#include "common/at.hpp"
#include "common/errors.hpp"
#include "common/gravity.hpp"

namespace softgrain::bpm {
namespace {

// Lists reach this far beyond what can act, in mean disc diameters.
constexpr double contact_skin = 0.25;
constexpr double attraction_skin = 0.5;
constexpr double largest_push = 0.05;  // overlap removed in a step [mean disc diameters]
constexpr std::size_t discs_worth_threads = 1000;
constexpr double bond_step = 0.85;                  // share of the largest stable time step of the bonds
constexpr long long least_unconverged_steps = 100;  // and more than this share of all steps: given up
constexpr double most_unconverged = 0.05;
// Units of Box2D in a diameter, times the step: discs may reach 4 sqrt(F0 d/m), the slop is 0.01 step.
constexpr double box2d_units = 0.5;
constexpr double most_box2d_units = 400.0;
constexpr double invalid_overlap = 0.05;  // that Box2D leaves [mean disc diameters]
constexpr double invalid_residual = 5.0;  // [tolerances] of a solve that did not converge

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

}  // namespace

BpmSolver::Assembly BpmSolver::assemble(const Scenario& scenario, const Packing& packing,
                                        const BpmSettings& settings) {
    const auto grains = static_cast<int>(packing.size());
    if (grains == 0) throw InputError("bpm: the packing has no grains");
    const std::vector<Aggregate> aggregates = prepare_grains(scenario, packing, settings);
    Assembly all;
    all.grain_start.push_back(0);
    for (int g = 0; g < grains; ++g) {
        const Aggregate& grain = aggregates[at(g)];
        const Mat2 frame = packing.frame_of(at(g));
        const double area = std::numbers::pi * packing.radius[at(g)] * packing.radius[at(g)];
        double square_sum = 0.0;
        for (double r : grain.radius) square_sum += r * r;
        for (std::size_t d = 0; d < grain.x.size(); ++d) {
            all.x.emplace_back(packing.center[at(g)] + frame * grain.x[d]);
            all.radius.push_back(grain.radius[d]);
            all.mass.push_back(scenario.material.density * area * grain.radius[d] * grain.radius[d] /
                               square_sum);
        }
        all.reference_area.push_back(area);
        all.internal_packing_fraction.push_back(grain.internal_packing_fraction);
        all.grain_start.push_back(static_cast<int>(all.x.size()));
    }
    return all;
}

BpmSolver::BpmSolver(const Scenario& scenario, const Packing& packing)
    : BpmSolver(scenario, packing, settings_of(scenario),
                assemble(scenario, packing, settings_of(scenario))) {}

BpmSolver::BpmSolver(const Scenario& scenario, const Packing& packing, const BpmSettings& settings,
                     Assembly assembly)
    : settings_(settings),
      rubs_(scenario.material.friction > 0.0 || settings.friction_within > 0.0),
      grain_start_(std::move(assembly.grain_start)),
      x_(std::move(assembly.x)),
      v_(x_.size(), Vec2::Zero()),
      force_(x_.size(), Vec2::Zero()),
      v_before_(x_.size(), Vec2::Zero()),
      radius_(std::move(assembly.radius)),
      mass_(std::move(assembly.mass)),
      rim_speed_(x_.size(), 0.0),
      rim_speed_before_(x_.size(), 0.0),
      diameter_(2.0 * mean_of(radius_)),
      maximum_force_(settings.stress_scale() * diameter_),
      attraction_({maximum_force_, settings.attraction_exponent, settings.attraction_range}, grain_start_,
                  radius_, attraction_skin * diameter_),
      contacts_({.tolerance = settings.tolerance * diameter_,
                 .skin = contact_skin * diameter_,
                 .max_iterations = settings.max_iterations,
                 .over_relaxation = settings.over_relaxation,
                 .within = {settings.friction_within, rubs_ ? settings.rolling_resistance : 0.0},
                 .between = {scenario.material.friction, rubs_ ? settings.rolling_resistance : 0.0},
                 .largest_push = largest_push * diameter_}),
      threads_(x_.size() >= discs_worth_threads ? omp_get_max_threads() : 1),
      box_(packing.box),
      reference_area_(std::move(assembly.reference_area)),
      internal_packing_fraction_(std::move(assembly.internal_packing_fraction)) {
    for (std::size_t g = 0; g < grains(); ++g) {
        const int count = grain_start_[g + 1] - grain_start_[g];
        grain_.insert(grain_.end(), at(count), static_cast<int>(g));
        disc_count_.push_back(count);
        grain_mass_.push_back(scenario.material.density * reference_area_[g]);
    }
    if (settings.behaviour != GrainBehaviour::plastic) {
        bonds_.emplace(
            BondLaw{settings.bond_stiffness, settings.bond_damping,
                    settings.behaviour == GrainBehaviour::brittle ? settings.bond_strength * diameter_
                                                                  : std::numeric_limits<double>::infinity(),
                    settings.bond_reach * diameter_},
            x_, radius_, mass_, grain_);
        contacts_.exclude(bonds_->pairs(), discs(), box_);
    }
    time_step_ = time_step(settings.step);
    place(packing.box, time_step(settings.placing_step));
    if (settings.engine == Engine::box2d)
        box2d_.emplace(Box2dSettings{.velocity_iterations = settings.velocity_iterations,
                                     .position_iterations = settings.position_iterations,
                                     .friction = scenario.material.friction,
                                     .units = std::min(most_box2d_units, box2d_units / settings.step),
                                     .diameter = diameter_,
                                     .mass = mean_of(mass_),
                                     .time = time_step(1.0)},
                       discs(), box_);
    potential_at_start_ = inner_energy();
    x_start_ = x_;
    gravity_ = gravity_of(scenario, packing);
}

void BpmSolver::advance(const WallMotion& walls, double dt) {
    step(walls, dt);
    account(walls, dt);
    note_convergence();
    break_bonds();
}

void BpmSolver::break_bonds() {
    if (!bonds_) return;
    const double released = bonds_->break_bonds(x_);
    if (released < 0.0) return;
    energy_.plastic += released;
    contacts_.exclude(bonds_->pairs(), discs(), box_);
}

void BpmSolver::note_convergence() {
    ++steps_;
    if (contact_result_.converged) return;
    ++unconverged_steps_;
    if (unconverged_steps_ < least_unconverged_steps ||
        static_cast<double>(unconverged_steps_) < most_unconverged * static_cast<double>(steps_))
        return;
    throw DivergedError(-1, "contact forces", time_,
                        fmt::format("{} of {} steps did not converge within {} sweeps; load more slowly, use "
                                    "a smaller bpm.step or a larger bpm.max_iterations",
                                    unconverged_steps_, steps_, settings_.max_iterations));
}

SolvedContacts BpmSolver::solved_contacts() const {
    return box2d_ ? box2d_->contacts() : SolvedContacts{contacts_.rows(), contacts_.wall_rows()};
}

double BpmSolver::time_step(double step) const {
    if (!bonds_) return step * std::sqrt(governing_mass(mass_) * diameter_ / maximum_force_);
    const double damping = settings_.bond_damping;
    return bond_step * bonds_->stable_time_step(mass_) * (std::sqrt(1.0 + damping * damping) - damping);
}

void BpmSolver::step(const WallMotion& walls, double h) {
    const double start = omp_get_wtime();
    if (bonds_)
        bonds_->forces(x_, v_, force_, threads_.parallel());
    else
        attraction_.forces(x_, time_, force_, true, threads_.parallel());
    if (!gravity_.isZero(0.0))
        for (std::size_t d = 0; d < x_.size(); ++d) force_[d] += mass_[d] * gravity_;
#pragma omp parallel for schedule(static) if (threads_.parallel())
    for (std::size_t d = 0; d < x_.size(); ++d) {
        v_before_[d] = v_[d];
        v_[d] += h / mass_[d] * force_[d];
    }
    if (rubs_) rim_speed_before_ = rim_speed_;
    if (box2d_) {
        x_before_ = x_;
        contact_result_ = box2d_->solve(discs(), walls, h, x_);
        watch(h, box2d_->largest_move());
    } else {
        contact_result_ = contacts_.solve(discs(), walls, h, threads_.parallel());
        watch(h, diameter_);
#pragma omp parallel for schedule(static) if (threads_.parallel())
        for (std::size_t d = 0; d < x_.size(); ++d) x_[d] += h * v_[d];
    }
    time_ += h;
    last_step_ = h;
    box_ = walls.after(h);
    threads_.note(omp_get_wtime() - start);

    penetration_ = contact_result_.penetration / diameter_;

    wall_force_.fill(Vec2::Zero());
    const WallRows& rows = solved_contacts().wall_rows;
    for (std::size_t k = 0; k < rows.size(); ++k)
        wall_force_[at(rows.wall[k])] -=
            mass_[at(rows.disc[k])] * rows.normal[k] / h * wall_normal(rows.wall[k]);
}

void BpmSolver::watch(double h, double largest_move) const {
    const double limit = largest_move * largest_move;
    std::size_t bad = v_.size();
#pragma omp parallel for schedule(static) reduction(min : bad) if (threads_.parallel())
    for (std::size_t d = 0; d < v_.size(); ++d)
        if (!(h * h * v_[d].squaredNorm() <= limit)) bad = std::min(bad, d);
    if (bad == v_.size()) return;
    const double moved = h * v_[bad].norm();
    throw DivergedError(
        grain_[bad], "disc velocity", time_,
        std::isfinite(moved)
            ? fmt::format(
                  "a disc moves {:.3g} diameters in one step; load more slowly or use a smaller bpm.step",
                  moved / diameter_)
            : std::string("not finite; load more slowly or use a smaller bpm.step"));
}

std::optional<std::string> BpmSolver::outside_validity() const {
    if (box2d_ && penetration_ > invalid_overlap)
        return fmt::format(
            "the rigid discs are jammed solid: Box2D leaves an overlap of {:.3g} disc diameters; the grains "
            "cannot be compacted further",
            penetration_);
    const double residual = contact_result_.residual / diameter_;
    if (contact_result_.converged || residual <= invalid_residual * settings_.tolerance) return std::nullopt;
    return fmt::format(
        "the rigid discs are jammed solid: {} sweeps of the contact solver leave a residual of {:.3g} disc "
        "diameters (tolerance {:.3g}); the grains cannot be compacted further",
        contact_result_.iterations, residual, settings_.tolerance);
}

}  // namespace softgrain::bpm
