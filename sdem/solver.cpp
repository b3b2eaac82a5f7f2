// One step of SDEM. Equation numbers: Mollon 2022 (see README.md for where they are corrected).
#include "sdem/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "common/errors.hpp"

namespace softgrain::sdem {
namespace {

constexpr std::size_t threads_pay_off = 400;  // grains
constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
constexpr double smallest_det = 0.05;

double contraction(const Mat2& a, const Mat2& b) {
    return a.cwiseProduct(b).sum();
}

/// sum S / (pi R^2). Once caps cover more than the whole outline they overlap: the sum counts areas twice,
/// grows faster than the area it is to be weighed against, and Eq. 41 and 68 run away. Scaled back by (pi/sum
/// psi)^3, as caps go with psi^3, each outline is counted once.
double cap_fraction(const GrainForces& sum, double reference_area) {
    const double covered = std::max(1.0, sum.covered);
    return sum.caps / (reference_area * covered * covered * covered);
}

}  // namespace

SoftDiscSolver::SoftDiscSolver(const Material& material, const Packing& packing, const Mollon2022& law,
                               const Options& options)
    : options_(options), density_(material.density), law_(law), box_(packing.box) {
    for (std::size_t g = 0; g < packing.size(); ++g) {
        const double R = packing.radius[g];
        const double area = std::numbers::pi * R * R;
        grains_.radius.push_back(R);
        grains_.reference_area.push_back(area);
        grains_.mass.push_back(density_ * area);
        grains_.inertia.push_back(0.25 * density_ * area * R * R);
        grains_.position.push_back(packing.center[g]);
        grains_.velocity.emplace_back(Vec2::Zero());
        grains_.F.push_back(Mat2::Identity());
        grains_.F_rate.push_back(Mat2::Zero());
    }
    shape_.resize(size());
    reach_.resize(size());
    forces_.resize(size());
    wall_contact_.resize(4 * size());
    wall_mask_.assign(size(), 0);
    stored_.assign(size(), 0.0);
    damped_.assign(size(), 0.0);
    before_ = grains_.position;
    update_shapes(before_);
    rebuild_neighbors();
    evaluate_forces();
    for (std::size_t g = 0; g < size(); ++g)
        caps_before_.push_back(cap_fraction(forces_[g], grains_.reference_area[g]));
}

/// Calls the function with the Motion chosen by the options.
template <class Function>
decltype(auto) SoftDiscSolver::with_motion(Function&& function) const {
    const bool keep = options_.incompressible;
    switch (options_.kinematics) {
        case Kinematics::D2F0:
            return function(Motion<Kinematics::D2F0, false>{});
        case Kinematics::D2F1:
            return keep ? function(Motion<Kinematics::D2F1, true>{})
                        : function(Motion<Kinematics::D2F1, false>{});
        default:
            return keep ? function(Motion<Kinematics::D2F3, true>{})
                        : function(Motion<Kinematics::D2F3, false>{});
    }
}

void SoftDiscSolver::advance(const WallMotion& walls, double dt) {
    std::array<double, 4> mean_velocity;
    for (std::size_t w = 0; w < 4; ++w) mean_velocity[w] = 0.5 * (wall_velocity_[w] + walls.velocity[w]);
    add_wall_work(ledger_, mean_velocity, dt);
    wall_velocity_ = walls.velocity;

    with_motion([&](auto motion) { move<decltype(motion)>(dt); });
    time_ += dt;
    last_step_ = dt;
    box_ = walls.after(dt);

    update_shapes(before_);
    update_neighbors();
    evaluate_forces();
}

template <class MotionPolicy>
SoftDiscSolver::Kick SoftDiscSolver::kick(std::size_t g, double dt) const {
    const Grains& s = grains_;
    const GrainForces& sum = forces_[g];
    Kick k;
    k.velocity = s.velocity[g] + (dt / s.mass[g]) * sum.force;  // Eq. 58
    const Mat2 free_rate = s.F_rate[g] + (dt / s.inertia[g]) * sum.moment;
    k.F_rate = MotionPolicy::allowed(s.F[g], free_rate);
    // Work at the mean of the velocities before and after equals the change of kinetic energy to rounding.
    const Vec2 v = 0.5 * (s.velocity[g] + k.velocity);
    const Mat2 L = 0.5 * (s.F_rate[g] + k.F_rate);
    k.damped = -dt * (sum.damping_force.dot(v) + contraction(sum.damping_moment, L));
    k.stored = -dt * (sum.force.dot(v) + contraction(sum.moment, L)) - k.damped;
    if constexpr (!std::is_same_v<MotionPolicy, Motion<Kinematics::D2F3, false>>)
        k.stored -= s.inertia[g] * contraction(k.F_rate - free_rate, L);  // the constraint's reaction
    return k;
}

template <class MotionPolicy>
void SoftDiscSolver::move(double dt) {
    Grains& s = grains_;
#pragma omp parallel for schedule(static) if (size() >= threads_pay_off)
    for (std::size_t g = 0; g < size(); ++g) {
        const Kick k = kick<MotionPolicy>(g, dt);
        stored_[g] = k.stored;
        damped_[g] = k.damped;
        s.velocity[g] = k.velocity;
        s.F_rate[g] = k.F_rate;
        before_[g] = s.position[g];
        s.position[g] += dt * k.velocity;  // Eq. 59
        s.F[g] += dt * k.F_rate;
        if constexpr (MotionPolicy::corrects) {
            const Mat2 before = s.F[g];
            // Caps at the new positions, extrapolated: the last ones would lag a step and feed energy in.
            const double caps = cap_fraction(forces_[g], s.reference_area[g]);
            const double expected = std::max(0.0, 2.0 * caps - caps_before_[g]);
            caps_before_[g] = caps;
            s.F[g] = MotionPolicy::corrected(before, expected);
            s.F_rate[g] = MotionPolicy::carried(before, s.F[g], k.F_rate);
            stored_[g] -= 0.5 * s.inertia[g] * (s.F_rate[g].squaredNorm() - k.F_rate.squaredNorm());
        }
    }
    for (std::size_t g = 0; g < size(); ++g) {
        ledger_.elastic += stored_[g];
        ledger_.damping += damped_[g];
    }
}

void SoftDiscSolver::update_shapes(std::span<const Vec2> before) {
    const Grains& s = grains_;
    std::size_t bad = nobody;
#pragma omp parallel for schedule(static) reduction(min : bad) if (size() >= threads_pay_off)
    for (std::size_t g = 0; g < size(); ++g) {
        shape_[g] = make_ellipse(s.position[g], s.F[g], s.radius[g]);
        reach_[g] = shape_[g].bounding;
        const double longest = 0.5 * s.radius[g];
        const bool near = (s.position[g] - before[g]).squaredNorm() <= longest * longest;
        const bool sound = shape_[g].det > smallest_det * s.radius[g] * s.radius[g] &&
                           reach_[g] < std::numeric_limits<double>::infinity();
        if (!near || !sound) bad = std::min(bad, g);
    }
    if (bad == nobody) return;
    const int g = static_cast<int>(bad);
    const Vec2 step = s.position[bad] - before[bad];
    if (!(step.norm() <= 0.5 * s.radius[bad]))
        throw DivergedError(g, "position", time_,
                            fmt::format("moved {:.3g} radii in one step; use a smaller sdem.safety",
                                        step.norm() / s.radius[bad]));
    throw DivergedError(g, "det F", time_,
                        fmt::format("{:.3g}: the grain is crushed or inside out", s.F[bad].determinant()));
}

void SoftDiscSolver::update_neighbors() {
    if (neighbors_.stale(grains_.position, reach_)) rebuild_neighbors();
}

/// Warm starts move with their pairs.
void SoftDiscSolver::rebuild_neighbors() {
    const std::vector<Pair> old_pairs(neighbors_.pairs().begin(), neighbors_.pairs().end());
    const std::vector<WarmStart> old_warm = std::move(warm_);
    double mean_radius = 0.0;
    for (double R : grains_.radius) mean_radius += R / static_cast<double>(size());
    neighbors_.build(grains_.position, reach_, options_.skin * mean_radius);
    pairs_of_.build(neighbors_.pairs(), size());
    warm_.assign(neighbors_.pairs().size(), WarmStart{});
    std::size_t o = 0;
    for (std::size_t k = 0; k < warm_.size(); ++k) {
        const Pair& pair = neighbors_.pairs()[k];
        while (o < old_pairs.size() && old_pairs[o] < pair) ++o;
        if (o < old_pairs.size() && old_pairs[o] == pair) warm_[k] = old_warm[o];
    }
    pair_contact_.resize(warm_.size());
}

void SoftDiscSolver::evaluate_forces() {
    evaluate_pairs();
    std::size_t bad = nobody;
#pragma omp parallel for schedule(static) reduction(min : bad) if (size() >= threads_pay_off)
    for (std::size_t g = 0; g < size(); ++g) {
        GrainForces sum{Vec2::Zero(), Mat2::Zero(), Vec2::Zero(), Mat2::Zero(), 0.0, 0.0};
        if (!add_walls(g, sum)) bad = std::min(bad, g);
        add_pairs(g, sum);
        add_inner_stress(g, sum);
        forces_[g] = sum;
    }
    if (bad != nobody)
        throw DivergedError(static_cast<int>(bad), "wall contact", time_,
                            "the grain went through a wall, or its cap is too deep for Eq. 57");
    sum_wall_forces();
}

/// Every pair of the neighbour list on its own, in any order.
void SoftDiscSolver::evaluate_pairs() {
    const Grains& s = grains_;
    warm_before_ = warm_;
    const std::span<const Pair> pairs = neighbors_.pairs();
    std::size_t bad = nobody;
#pragma omp parallel for schedule(static) reduction(min : bad) if (size() >= threads_pay_off)
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto i = static_cast<std::size_t>(pairs[k].i), j = static_cast<std::size_t>(pairs[k].j);
        const double reach = reach_[i] + reach_[j];
        if ((s.position[j] - s.position[i]).squaredNorm() >= reach * reach) {
            pair_contact_[k].overlap = Overlap::none;
            warm_[k] = WarmStart{};
            continue;
        }
        pair_contact_[k] = pair_contact(moving(i), moving(j), law_, warm_[k]);
        const PairContact& c = pair_contact_[k];
        const bool sound = c.overlap == Overlap::none || (c.touching() && c.force.stiffness > 0.0);
        if (!sound) bad = std::min(bad, k);
    }
    if (bad != nobody) throw_bad_contact(bad);
}

/// Contacts with walls; false if one of them is beyond the law.
bool SoftDiscSolver::add_walls(std::size_t g, GrainForces& sum) {
    bool sound = true;
    wall_mask_[g] = 0;
    for (int w = 0; w < 4; ++w) {
        const double distance = box_.distance(w, grains_.position[g]);
        if (distance >= reach_[g]) continue;
        const WallChord chord = wall_chord(shape_[g], wall_normal(w), distance);
        if (!chord.touching) continue;
        const auto wall = static_cast<std::size_t>(w);
        WallContact& c = wall_contact_[4 * g + wall];
        c = wall_contact(moving(g), chord, wall_normal(w), WallMotion{box_, wall_velocity_}.velocity_of(w),
                         law_);
        wall_mask_[g] = static_cast<std::uint8_t>(wall_mask_[g] | (1U << wall));
        add_contact(sum, c.force, wall_normal(w), c.grain);
        sound = sound && !chord.escaped && c.force.stiffness > 0.0;
    }
    return sound;
}

/// Contacts with other grains, in the order of the pair list.
void SoftDiscSolver::add_pairs(std::size_t g, GrainForces& sum) const {
    for (const PairsOfGrain::Entry& entry : pairs_of_.of(g)) {
        const PairContact& c = pair_contact_[static_cast<std::size_t>(entry.pair)];
        if (c.overlap == Overlap::none) continue;
        if (entry.second)
            add_contact(sum, c.force, c.normal, c.j);
        else
            add_contact(sum, c.force, -c.normal, c.i);
    }
}

/// - A0 P, and shape damping (Eq. 62-64) without the spin, which those leave alone.
void SoftDiscSolver::add_inner_stress(std::size_t g, GrainForces& sum) const {
    const Mat2& F = grains_.F[g];
    const double R = grains_.radius[g], A0 = grains_.reference_area[g];
    const double eps_v = shape_[g].det / (R * R) - cap_fraction(sum, A0) - 1.0;  // Eq. 41
    const double rate = options_.shape_damping * std::sqrt(law_.E / density_) / R;
    const Mat2 damping = (-rate * grains_.inertia[g]) * without_spin(F, grains_.F_rate[g]);
    sum.moment += damping - A0 * law_.piola(F, Polar(F), eps_v);  // Eq. 42, 43
    sum.damping_moment += damping;
}

void SoftDiscSolver::sum_wall_forces() {
    wall_force_.fill(Vec2::Zero());
    wall_damping_force_.fill(Vec2::Zero());
    for (std::size_t g = 0; g < size(); ++g) {
        if (wall_mask_[g] == 0) continue;
        for (std::size_t w = 0; w < 4; ++w) {
            if ((wall_mask_[g] >> w & 1U) == 0) continue;
            const Vec2 outward = -wall_normal(static_cast<int>(w));
            wall_force_[w] += wall_contact_[4 * g + w].force.total * outward;
            wall_damping_force_[w] += wall_contact_[4 * g + w].force.damping * outward;
        }
    }
}

void SoftDiscSolver::throw_bad_contact(std::size_t k) const {
    const Pair& pair = neighbors_.pairs()[k];
    const auto why = [&]() -> const char* {
        switch (pair_contact_[k].overlap) {
            case Overlap::contained:
                return "one grain lies inside the other";
            case Overlap::coincident:
                return "the two centres coincide";
            default:
                return "the caps are too deep for Eq. 57";
        }
    };
    throw DivergedError(pair.i, "contact", time_, fmt::format("with grain {}: {}", pair.j, why()));
}

/// Force times wall displacement; the walls' share of damping goes to `damping`, the rest is stored.
void SoftDiscSolver::add_wall_work(EnergyLedger& ledger, const std::array<double, 4>& wall_velocity,
                                   double dt) const {
    for (std::size_t w = 0; w < 4; ++w) {
        const int axis = wall_axis(static_cast<int>(w));
        const double work = -wall_force_[w][axis] * wall_velocity[w] * dt;
        const double damped = -wall_damping_force_[w][axis] * wall_velocity[w] * dt;
        ledger.external_work += work;
        ledger.damping += damped;
        ledger.elastic += work - damped;
    }
}

/// The ledger at the present positions: half a step further than the velocities kept.
template <class MotionPolicy>
EnergyLedger SoftDiscSolver::energy_now() const {
    EnergyLedger ledger = ledger_;
    const double half = 0.5 * last_step_;
    add_wall_work(ledger, wall_velocity_, half);
    for (std::size_t g = 0; g < size(); ++g) {
        const Kick k = kick<MotionPolicy>(g, half);
        ledger.elastic += k.stored;
        ledger.damping += k.damped;
        ledger.kinetic +=
            0.5 * (grains_.mass[g] * k.velocity.squaredNorm() + grains_.inertia[g] * k.F_rate.squaredNorm());
    }
    return ledger;
}

EnergyLedger SoftDiscSolver::energy() const {
    return with_motion([&](auto motion) { return energy_now<decltype(motion)>(); });
}

}  // namespace softgrain::sdem
