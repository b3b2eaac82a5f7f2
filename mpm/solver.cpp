#include "mpm/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/errors.hpp"
#include "common/stop.hpp"
#include "mpm/linear/front_solver.hpp"

namespace softgrain::mpm {
namespace {

/// A step without equilibrium is halved so often.
constexpr int most_halvings_of_motion = 10;
/// Share of the undeformed area of all grains that walls may not go below: nothing is solid there.
constexpr double least_area = 0.2;

Box between(const Box& from, const Box& to, double share) {
    Box box = from;
    for (std::size_t w = 0; w < 4; ++w) box.position[w] += share * (to.position[w] - from.position[w]);
    return box;
}

}  // namespace

MpmSolver::MpmSolver(const Scenario& scenario, const Packing& packing)
    : settings_(settings_of(scenario)), box_(packing.box) {
    if (packing.size() == 0) throw InputError("mpm: the packing has no grains");
    const Material& material = scenario.material;
    EquilibriumSettings& implicit = settings_.equilibrium;
    ExplicitSettings& motion = settings_.motion;
    implicit.gravity = motion.gravity = scenario.box.gravity;
    implicit.friction = motion.friction = material.friction;
    implicit.wall_friction = motion.wall_friction = material.wall_friction;
    if (motion.common_grid) {
        motion.common_grid->friction = material.friction;
        motion.common_grid->wall_friction = material.wall_friction;
    }
    make_grains(scenario, packing);
    motion.damping /= crossing_;
    forces_ = std::make_unique<GrainForces>(*grains_.disc, *grains_.pattern, implicit.mean_dilatation);
    if (settings_.driver == Driver::explicit_steps) {
        motion_ = std::make_unique<ExplicitMotion>(grains_, motion);
        motion_->begin(q_, box_);
    } else {
        equilibrium_ =
            std::make_unique<Equilibrium>(grains_, implicit, std::make_unique<FrontSolver>(grains_));
        if (std::ranges::any_of(grains_.law, [](const auto& law) { return law->remembers(); }))
            equilibrium_->plastic.resize(grains_.size() * grains_.points());
    }
    force_.resize(q_.size());
    placed_ = packing.center;
    evaluate();
    wall_force_ = motion_ ? motion_->wall_force() : equilibrium_->wall_force();
    velocity_.assign(grains_.size(), Vec2::Zero());
    find_centroids();
    find_energy();
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
        // A mirrored grain is the mirrored disc, its surface still counter-clockwise.
        if (grain.frame.determinant() < 0.0) grain.frame.col(0) *= -1.0;
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
        crossing_ = std::min(crossing_, R * std::sqrt(grain.density / material.youngs_modulus));
    }
    v_.assign(q_.size(), Vec2::Zero());
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
    Checkpoint before;
    if (equilibrium_) save(before);
    try {
        make_step(walls, dt);
    } catch (const StopAsked&) {
        load(before);
        throw;
    }
}

void MpmSolver::make_step(const WallMotion& walls, double dt) {
    box_ = walls.box;
    check_room(walls.after(dt), dt);
    strain_rate_ =
        std::max(std::abs(walls.width_rate()) / box_.width(), std::abs(walls.height_rate()) / box_.height());
    if (motion_)
        advance_explicitly(walls, dt);
    else
        advance_implicitly(walls, dt);
}

void MpmSolver::advance_explicitly(const WallMotion& walls, double dt) {
    const double steps = std::max(1.0, std::ceil(dt / motion_->stable_time_step() * (1.0 - 1e-9)));
    const Box end = walls.after(dt);
    for (double k = 1.0; k <= steps; ++k) {
        const int inside_out =
            motion_->step(q_, v_, k == steps ? end : between(walls.box, end, k / steps), dt / steps);
        if (inside_out >= 0)
            throw DivergedError(inside_out, "deformation", time_ + k / steps * dt,
                                "the grain is inside out; start from a packing without deep overlaps, or set "
                                "mpm.penalty or mpm.safety lower");
    }
    time_ += dt;
    box_ = end;
    wall_force_ = motion_->wall_force();
    find_centroids();
    for (std::size_t g = 0; g < grains_.size(); ++g)
        velocity_[g] = motion_->mass().momentum(grains_.of(v_, g)) / std::numbers::pi;
    energy_ = motion_->energy(v_);
}

void MpmSolver::advance_implicitly(const WallMotion& walls, double dt) {
    const std::vector<Vec2> before = centroid_;
    const Box end = walls.after(dt);
    double parts = strain_rate_ * dt / settings_.strain_step;
    if (settings_.driver == Driver::implicit) parts = std::max(parts, dt / (settings_.time_step * crossing_));
    parts = std::max(1.0, std::ceil(parts * (1.0 - 1e-9)));
    EquilibriumResult result;
    iterations_of_step_ = 0.0;
    double done = 0.0, part = 1.0 / parts;
    int halvings = 0;
    while (done < 1.0) {
        const double next = done + part > 1.0 - 1e-9 ? 1.0 : done + part;
        if (move_walls(next == 1.0 ? end : between(walls.box, end, next), (next - done) * dt, result)) {
            done = next;
            if (halvings > 0) {
                --halvings;
                part *= 2.0;
            }
            continue;
        }
        part *= 0.5;
        if (++halvings > most_halvings_of_motion)
            throw DivergedError(result.worst_node / static_cast<int>(grains_.nodes()), "equilibrium",
                                time_ + done * dt,
                                result.why + "; the walls cannot go on even by a thousandth of a step");
    }
    time_ += dt;
    for (std::size_t g = 0; g < grains_.size(); ++g) velocity_[g] = (centroid_[g] - before[g]) / dt;
}

void MpmSolver::check_room(const Box& box, double dt) const {
    double area = 0.0;
    for (const double a : reference_area_) area += a;
    if (!(box.width() > 0.0 && box.height() > 0.0 && box.area() > least_area * area))
        throw DivergedError(
            -1, "box", time_,
            fmt::format("the walls would leave {:.3g} x {:.3g} m for grains of {:.3g} m^2 in a step of "
                        "{:.3g} s",
                        box.width(), box.height(), area, dt));
}

double MpmSolver::stable_time_step() const {
    if (motion_) return motion_->stable_time_step();
    double dt = settings_.driver == Driver::implicit ? settings_.time_step * crossing_
                                                     : std::numeric_limits<double>::infinity();
    if (strain_rate_ > 0.0) dt = std::min(dt, settings_.strain_step / strain_rate_);
    return dt;
}

bool MpmSolver::move_walls(const Box& to, double dt, EquilibriumResult& result) {
    const std::vector<Vec2> before = q_;
    const bool dynamic = settings_.driver == Driver::implicit;
    if (dynamic) {
        for (std::size_t m = 0; m < q_.size(); ++m) q_[m] += dt * v_[m];
        equilibrium_->set_inertia(q_, dt);
        q_ = before;
    }
    result = equilibrium_->find(q_, to);
    iterations_ += result.iterations;
    iterations_of_step_ += result.iterations;
    if (!result.converged) {
        q_ = before;
        return false;
    }
    for (std::size_t m = 0; dynamic && m < q_.size(); ++m) v_[m] = (q_[m] - before[m]) / dt;
    const std::array<Vec2, 4> force = equilibrium_->wall_force();
    double work = -work_of_gravity();
    for (int w = 0; w < 4; ++w) {
        const auto k = static_cast<std::size_t>(w);
        const int axis = wall_axis(w);
        const double pushed =
            0.5 * (wall_force_[k][axis] + force[k][axis]) * (to.position[k] - box_.position[k]);
        energy_.external_work -= pushed;
        work -= pushed;
    }
    wall_force_ = force;
    box_ = to;
    flow();
    find_centroids();
    // What rearrangements set free is taken away by the search for the next equilibrium, or by Euler's
    // method.
    const double stored = energy_.elastic + energy_.kinetic, plastic = energy_.plastic;
    const double rubbed = equilibrium_->friction().end();
    energy_.friction += rubbed;
    find_energy();
    energy_.damping += work + work_of_gravity() - (energy_.elastic + energy_.kinetic - stored) -
                       (energy_.plastic - plastic) - rubbed;
    return true;
}

void MpmSolver::find_energy() {
    if (motion_) {
        energy_ = motion_->energy(v_);
        return;
    }
    energy_.elastic = equilibrium_->plastic.empty() ? equilibrium_->elastic_energy() : stored_energy();
    energy_.elastic += equilibrium_->friction().stored();
    energy_.plastic = dissipated_by_flow();
    energy_.kinetic = settings_.driver == Driver::implicit ? kinetic_energy() : 0.0;
}

double MpmSolver::kinetic_energy() const {
    double sum = 0.0;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        sum += 0.5 * grains_.grain[g].density * grains_.grain[g].area *
               equilibrium_->mass().squared(grains_.of(v_, g));
    return sum;
}

void MpmSolver::find_centroids() {
    centroid_.assign(grains_.size(), Vec2::Zero());
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const auto q = grains_.of(q_, g);
        for (std::size_t m = 0; m < q.size(); ++m) centroid_[g] += grains_.disc->integral[m] * q[m];
        centroid_[g] /= std::numbers::pi;
    }
}

/// Plastic states follow the equilibrium.
void MpmSolver::flow() {
    if (equilibrium_->plastic.empty()) return;
    for (std::size_t g = 0; g < grains_.size(); ++g)
        grains_.grain[g].law->flow(forces_->deformation(grains_.grain[g], grains_.of(q_, g)),
                                   grains_.of_points(equilibrium_->plastic, g));
}

/// Energy, forces and contacts of the state as it is.
void MpmSolver::evaluate() {
    if (equilibrium_) equilibrium_->begin_slip(q_, box_, force_);
}

}  // namespace softgrain::mpm
