#include "mpm/solver.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "mpm/linear/front_solver.hpp"

namespace softgrain::mpm {
namespace {

/// A step without equilibrium is halved so often.
constexpr int most_halvings = 10;

double largest_motion(const Box& from, const Box& to) {
    double largest = 0.0;
    for (std::size_t w = 0; w < 4; ++w)
        largest = std::max(largest, std::abs(to.position[w] - from.position[w]));
    return largest;
}

Box between(const Box& from, const Box& to, double share) {
    Box box = from;
    for (std::size_t w = 0; w < 4; ++w) box.position[w] += share * (to.position[w] - from.position[w]);
    return box;
}

}  // namespace

MpmSolver::MpmSolver(const Scenario& scenario, const Packing& packing)
    : settings_(settings_of(scenario)), box_(packing.box) {
    if (packing.size() == 0) throw InputError("mpm: the packing has no grains");
    settings_.equilibrium.gravity = scenario.box.gravity;
    make_grains(scenario, packing);
    forces_ =
        std::make_unique<GrainForces>(*grains_.disc, *grains_.pattern, settings_.equilibrium.mean_dilatation);
    equilibrium_ =
        std::make_unique<Equilibrium>(grains_, settings_.equilibrium, std::make_unique<FrontSolver>(grains_));
    if (std::ranges::any_of(grains_.law, [](const auto& law) { return law->remembers(); }))
        equilibrium_->plastic.resize(grains_.size() * grains_.points());
    force_.resize(q_.size());
    view_grains();
    start_ = centroid_;
    const EquilibriumResult result = equilibrium_->find(q_, box_);
    if (!result.converged)
        throw DivergedError(result.worst_node / static_cast<int>(grains_.nodes()), "equilibrium", 0.0,
                            "of the initial packing: " + result.why);
    residual_ = result.residual;
    wall_force_ = equilibrium_->contacts().wall_force();
    flow();
}

void MpmSolver::make_grains(const Scenario& scenario, const Packing& packing) {
    grains_.disc = reference_disc(settings_.cells);
    grains_.pattern = std::make_shared<StiffnessPattern>(*grains_.disc);
    grains_.dissection = std::make_shared<Dissection>(*grains_.disc, *grains_.pattern);
    for (std::size_t c = 0; c < scenario.class_count(); ++c)
        grains_.law.push_back(make_law(settings_.law, scenario.material_of(c)));
    double area = 0.0;
    for (std::size_t g = 0; g < packing.size(); ++g) {
        const std::size_t c = packing.class_of(g);
        const Material& material = scenario.material_of(c);
        const double R = packing.radius[g], nu = material.poisson_ratio;
        Grain grain;
        grain.law = grains_.law[c].get();
        grain.frame = packing.shape_of(g) * packing.frame_of(g);
        grain.inverse_frame = grain.frame.inverse();
        grain.area = R * R;
        grain.radius = R;
        grain.density = material.density;
        grain.modulus = material.youngs_modulus / (1.0 - nu * nu);
        grains_.grain.push_back(grain);
        for (const Vec2& X : grains_.disc->coordinate) q_.push_back(packing.center[g] + grain.frame * X);
        reference_area_.push_back(std::numbers::pi * grain.area);
        mass_.push_back(grain.density * reference_area_.back());
        stress_scale_ += material.youngs_modulus * reference_area_.back();
        area += reference_area_.back();
    }
    stress_scale_ /= area;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        for (std::size_t p = 0; p < grains_.points(); ++p) {
            part_reference_.push_back(grains_.disc->at_points.at(p, grains_.of(q_, g)));
            part_radius_.push_back(
                std::sqrt(grains_.disc->weight[p] * grains_.grain[g].area / std::numbers::pi));
            part_grain_.push_back(static_cast<int>(g));
        }
}

void MpmSolver::advance(const WallMotion& walls, double dt) {
    view_grains();
    start_ = centroid_;
    box_ = walls.box;
    const Box end = walls.after(dt);
    const double most = settings_.strain_step * std::min(box_.width(), box_.height());
    const double parts = std::max(1.0, std::ceil(largest_motion(box_, end) / most * (1.0 - 1e-9)));
    EquilibriumResult result;
    iterations_of_step_ = 0.0;
    double done = 0.0, part = 1.0 / parts;
    int halvings = 0;
    while (done < 1.0) {
        const double next = done + part > 1.0 - 1e-9 ? 1.0 : done + part;
        if (move_walls(next == 1.0 ? end : between(walls.box, end, next), result)) {
            done = next;
            if (halvings > 0) {
                --halvings;
                part *= 2.0;
            }
            continue;
        }
        part *= 0.5;
        if (++halvings > most_halvings)
            throw DivergedError(result.worst_node / static_cast<int>(grains_.nodes()), "equilibrium",
                                time_ + done * dt,
                                result.why + "; the walls cannot move on, even by a thousandth of a step");
    }
    time_ += dt;
    view_grains();
    for (std::size_t g = 0; g < grains_.size(); ++g) velocity_[g] = (centroid_[g] - start_[g]) / dt;
}

bool MpmSolver::move_walls(const Box& to, EquilibriumResult& result) {
    std::vector<Vec2> q = q_;
    result = equilibrium_->find(q, to);
    iterations_ += result.iterations;
    iterations_of_step_ += result.iterations;
    if (!result.converged) return false;
    const std::array<Vec2, 4>& force = equilibrium_->contacts().wall_force();
    for (int w = 0; w < 4; ++w) {
        const auto k = static_cast<std::size_t>(w);
        const int axis = wall_axis(w);
        energy_.external_work -=
            0.5 * (wall_force_[k][axis] + force[k][axis]) * (to.position[k] - box_.position[k]);
    }
    q_.swap(q);
    wall_force_ = force;
    box_ = to;
    residual_ = result.residual;
    flow();
    return true;
}

/// Plastic states follow the equilibrium.
void MpmSolver::flow() {
    if (equilibrium_->plastic.empty()) return;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        grains_.grain[g].law->flow(
            forces_->deformation(grains_.grain[g], grains_.of(q_, g)),
            std::span(equilibrium_->plastic).subspan(g * grains_.points(), grains_.points()));
}

/// Energy, forces and contacts of the state as it is.
void MpmSolver::evaluate() {
    equilibrium_->evaluate(q_, box_, force_);
}

}  // namespace softgrain::mpm
