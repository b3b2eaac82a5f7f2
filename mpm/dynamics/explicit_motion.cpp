#include "mpm/dynamics/explicit_motion.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace softgrain::mpm {
namespace {

/// Steps between looks at how far grains have been deformed since their fastest modes were found.
constexpr long long steps_between_looks = 64;
constexpr std::size_t worth_threads = 2;  // grains

}  // namespace

ExplicitMotion::ExplicitMotion(Grains& grains, const ExplicitSettings& settings)
    : grains_(grains),
      threads_(grains.size() >= worth_threads ? omp_get_max_threads() : 1),
      settings_(settings),
      mass_(*grains.disc, *grains.pattern),
      work_(static_cast<std::size_t>(omp_get_max_threads()),
            GrainForces(*grains.disc, *grains.pattern, settings.mean_dilatation)),
      contacts_(grains, settings.penalty),
      friction_(grains, settings.friction, settings.wall_friction),
      fastest_(grains, mass_, settings.common_grid ? 0.0 : settings.penalty, settings.mean_dilatation),
      force_(grains.all_nodes()),
      acceleration_(grains.all_nodes()),
      elastic_(grains.size()) {
    if (settings.common_grid) grid_.emplace(grains, mass_, *settings.common_grid);
    if (std::ranges::any_of(grains.grain, [](const Grain& grain) { return grain.law->remembers(); }))
        plastic.resize(grains.size() * grains.points());
}

double ExplicitMotion::dissipated_by_flow(std::size_t g) const {
    if (plastic.empty()) return 0.0;
    const PlasticState* state = plastic.data() + g * grains_.points();
    double sum = 0.0;
    for (std::size_t p = 0; p < grains_.points(); ++p) sum += grains_.disc->weight[p] * state[p].dissipated;
    return sum * grains_.grain[g].area;
}

void ExplicitMotion::begin(std::span<const Vec2> q, const Box& box, const EnergyLedger& so_far) {
    box_ = box;
    counted_ = so_far;
    steps_ = 0;
    if (grid_) grid_->forget();
    evaluate(q, false);
    fastest_.find(q, plastic);
}

double ExplicitMotion::stable_time_step() const {
    return settings_.safety * 2.0 / std::sqrt(fastest_.squared_frequency());
}

int ExplicitMotion::step(std::span<Vec2> q, std::span<Vec2> v, const Box& after, double dt) {
    grains_.threads = threads_.parallel();
    const double begun = omp_get_wtime();
    const std::array<Vec2, 4> wall_force = contacts_.wall_force();
    if (grid_) {
        const std::vector<Vec2> last(v.begin(), v.end());
        kick(v, dt);
        collide(q, last, v, after, dt);
    } else {
        kick(v, 0.5 * dt);
    }
    for (std::size_t m = 0; m < q.size(); ++m) q[m] += dt * v[m];
    if (!settings_.gravity.isZero())
        for (std::size_t g = 0; g < grains_.size(); ++g)
            counted_.external_work +=
                dt * grains_.grain[g].density * grains_.grain[g].area *
                settings_.gravity.dot(mass_.momentum(v.subspan(g * grains_.nodes(), grains_.nodes())));
    const Box before = std::exchange(box_, after);
    ++steps_;
    const int inside_out = evaluate(q, true);
    if (inside_out >= 0) return inside_out;
    if (!grid_) {
        kick(v, 0.5 * dt);
        for (int w = 0; w < 4; ++w) {
            const auto k = static_cast<std::size_t>(w);
            const int axis = wall_axis(w);
            counted_.external_work -= 0.5 * (wall_force[k][axis] + contacts_.wall_force()[k][axis]) *
                                      (after.position[k] - before.position[k]);
        }
    }
    if (settings_.damping > 0.0) damp(q, v, dt);
    threads_.note(omp_get_wtime() - begun);
    return -1;
}

std::array<Vec2, 4> ExplicitMotion::wall_force() const {
    if (grid_) return grid_->wall_force();
    std::array<Vec2, 4> sum = contacts_.wall_force();
    for (std::size_t w = 0; w < sum.size(); ++w) sum[w] += friction_.wall_force()[w];
    return sum;
}

void ExplicitMotion::collide(std::span<const Vec2> q, std::span<const Vec2> last, std::span<Vec2> v,
                             const Box& after, double dt) {
    std::array<Vec2, 4> wall_velocity;
    for (int w = 0; w < 4; ++w) {
        const auto k = static_cast<std::size_t>(w);
        wall_velocity[k].setZero();
        wall_velocity[k][wall_axis(w)] = (after.position[k] - box_.position[k]) / dt;
    }
    grid_->collide(q, last, v, box_, wall_velocity, dt);
    counted_.impact += grid_->impact();
    counted_.friction += grid_->friction();
    counted_.external_work += grid_->work_of_walls();
}

int ExplicitMotion::evaluate(std::span<const Vec2> q, bool moved) {
    const bool looks = moved && steps_ % steps_between_looks == 0;
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) evaluate_grain(g, q, moved, looks);
    for (std::size_t g = 0; g < grains_.size(); ++g)
        if (!std::isfinite(elastic_[g])) return static_cast<int>(g);
    if (looks) fastest_.refresh(q, plastic);
    surfaces_.update(grains_, q);
    if (!grid_) {
        contacts_.evaluate(surfaces_, box_, force_);
        if (friction_.exists()) {
            friction_.lag(contacts_);
            if (!moved) friction_.begin(surfaces_);
            friction_.evaluate(surfaces_, force_);
            if (moved) counted_.friction += friction_.end();
            friction_.begin(surfaces_);
        }
    }
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const std::span<Vec2> a = grains_.of(acceleration_, g);
        std::ranges::copy(grains_.of(force_, g), a.begin());
        mass_.solve(a);
        const double per_mass = -1.0 / (grains_.grain[g].density * grains_.grain[g].area);
        for (Vec2& x : a) x = per_mass * x + settings_.gravity;
    }
    return -1;
}

void ExplicitMotion::evaluate_grain(std::size_t g, std::span<const Vec2> q, bool flows, bool looks) {
    const Grain& grain = grains_.grain[g];
    GrainForces& work = work_[static_cast<std::size_t>(omp_get_thread_num())];
    const std::span<Vec2> force = grains_.of(force_, g);
    std::ranges::fill(force, Vec2::Zero());
    const double energy = work.evaluate(grain, q.subspan(g * grains_.nodes(), grains_.nodes()),
                                        grains_.of_points(plastic, g), force, {});
    elastic_[g] = energy;
    if (!std::isfinite(energy)) return;
    if (flows && !plastic.empty()) {
        // The energy of a plastic law is with what it dissipates.
        const double before = dissipated_by_flow(g);
        grain.law->flow(work.deformation(), grains_.of_points(plastic, g));
        elastic_[g] -= dissipated_by_flow(g) - before;
    }
    if (looks) fastest_.look_at(g, work.deformation());
}

void ExplicitMotion::kick(std::span<Vec2> v, double dt) {
    for (std::size_t m = 0; m < v.size(); ++m) v[m] += dt * acceleration_[m];
}

void ExplicitMotion::damp(std::span<const Vec2> q, std::span<Vec2> v, double dt) {
    const std::size_t nodes = grains_.nodes();
    const double half = 0.5 * settings_.damping * dt, kept = (1.0 - half) / (1.0 + half);
    std::vector<double> lost(grains_.size());
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        const std::span<Vec2> own = v.subspan(g * nodes, nodes);
        const RigidMotion rigid = mass_.rigid_motion(q.subspan(g * nodes, nodes), own);
        std::vector<Vec2> rest(nodes);
        for (std::size_t m = 0; m < nodes; ++m) {
            const Vec2 as_rigid = rigid.at(q[g * nodes + m]);
            rest[m] = own[m] - as_rigid;
            own[m] = as_rigid + kept * rest[m];
        }
        lost[g] = 0.5 * grains_.grain[g].density * grains_.grain[g].area * (1.0 - kept * kept) *
                  mass_.squared(rest);
    }
    for (const double energy : lost) counted_.damping += energy;
}

double ExplicitMotion::kinetic_energy(std::span<const Vec2> v) const {
    const std::size_t nodes = grains_.nodes();
    std::vector<double> of_grain(grains_.size());
#pragma omp parallel for schedule(static) if (grains_.threads)
    for (std::size_t g = 0; g < grains_.size(); ++g)
        of_grain[g] = 0.5 * grains_.grain[g].density * grains_.grain[g].area *
                      mass_.squared(v.subspan(g * nodes, nodes));
    double sum = 0.0;
    for (const double e : of_grain) sum += e;
    return sum;
}

EnergyLedger ExplicitMotion::energy(std::span<const Vec2> v) const {
    EnergyLedger energy = counted_;
    energy.kinetic = kinetic_energy(v);
    energy.elastic = grid_ ? 0.0 : contacts_.energy() + friction_.stored();
    energy.plastic = 0.0;
    for (std::size_t g = 0; g < grains_.size(); ++g) {
        energy.elastic += elastic_[g];
        energy.plastic += dissipated_by_flow(g);
    }
    return energy;
}

}  // namespace softgrain::mpm
