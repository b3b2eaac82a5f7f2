#include "rigid_dem/solver.hpp"

#include <fmt/format.h>

#include <numbers>

#include "common/errors.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr std::size_t worth_threads = 2000;  ///< pairs or grains below which one thread is faster

}  // namespace

RigidDem::RigidDem(const Scenario& scenario, const Packing& packing)
    : law_(parameters_of(scenario)),
      box_(packing.box),
      walls_{packing.box, {}, 0.0},
      radius_(packing.radius),
      x_(packing.center) {
    const std::size_t n = packing.size();
    for (std::size_t i = 0; i < n; ++i) {
        const Material& material = scenario.material_of(packing.class_of(i));
        reference_area_.push_back(std::numbers::pi * radius_[i] * radius_[i]);
        mass_.push_back(material.density * reference_area_.back());
        stiffness_.push_back(law_.stiffness * material.youngs_modulus);
        mean_modulus_ += material.youngs_modulus / static_cast<double>(n);
        largest_stiffness_ = std::max(largest_stiffness_, stiffness_.back());
    }
    if (scenario.class_count() == 1) mean_modulus_ = scenario.material_of(0).youngs_modulus;
    v_.assign(n, Vec2::Zero());
    force_.assign(n, Vec2::Zero());
    spin_.assign(n, 0.0);
    torque_.assign(n, 0.0);
    frequency2_.assign(n, 0.0);
    wall_normal_force_.assign(4 * n, 0.0);
    wall_overlap_.assign(4 * n, 0.0);
    wall_dashpot_.assign(4 * n, 0.0);
    wall_damping_.assign(4 * n, 0.0);
    flips_ = box_.periodic ? box_.flips() : 0;
    if (box_.periodic) wrap(walls_.flipped(flips_));
    list_neighbors();
    evaluate_forces(walls_, 0.0);
    account_energy(0.0);
}

void RigidDem::advance(const WallMotion& walls, double dt) {
    // Leap-frog (DEM course, "Explicit FD scheme"): forces of the present positions change the velocities.
    const bool rotates = law_.friction > 0.0;
    if (box_.periodic) carry_along(walls);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        v_[i] += force_[i] * (dt / mass_[i]);
        const Vec2 own = box_.periodic ? Vec2(v_[i] - walls.affine_velocity(x_[i])) : v_[i];
        x_[i] += v_[i] * dt;
        if (rotates) spin_[i] += torque_[i] * (2.0 * dt / (mass_[i] * radius_[i] * radius_[i]));
        if (!(own.squaredNorm() * dt * dt < radius_[i] * radius_[i]))
            throw DivergedError(
                static_cast<int>(i), "velocity", time_,
                fmt::format("it moves {:.3g} radii in one step", own.norm() * dt / radius_[i]));
    }
    box_ = walls.after(dt);
    walls_ = {box_, walls.velocity, walls.tilt_rate};
    time_ += dt;
    if (neighbors_.stale(x_, radius_, box_.flipped(flips_))) {
        flips_ = box_.periodic ? box_.flips() : 0;
        if (box_.periodic) wrap(walls_.flipped(flips_));
        list_neighbors();
    }

    wall_force_before_ = wall_force_;
    const Mat2 pushed_before = cell_virial_ + kinetic_tensor_;
    evaluate_forces(walls_, dt);
    // Trapezoidal rule; walls and cell push with the opposite of what they feel.
    for (std::size_t w = 0; w < 4; ++w)
        energy_.external_work -=
            0.5 * (wall_force_[w] + wall_force_before_[w]).dot(walls.velocity_of(static_cast<int>(w))) * dt;
    if (box_.periodic) {
        kinetic_tensor_ = kinetic_tensor(dt);
        const Mat2 before = pushed_before.cwiseProduct(walls.velocity_gradient());
        const Mat2 after = (cell_virial_ + kinetic_tensor_).cwiseProduct(walls_.velocity_gradient());
        energy_.external_work -= 0.5 * (before + after).sum() * dt;
    }
    account_energy(dt);
}

void RigidDem::list_neighbors() {
    const std::vector<Pair> old(neighbors_.pairs().begin(), neighbors_.pairs().end());
    const double smallest = *std::min_element(radius_.begin(), radius_.end());
    neighbors_.build(x_, radius_, law_.skin * smallest, box_.flipped(flips_));
    const auto pairs = neighbors_.pairs();
    pairs_of_.build(pairs, x_.size());
    std::vector<ContactMemory> kept(pairs.size());
    for (std::size_t k = 0, m = 0; k < pairs.size(); ++k) {  // both lists are sorted
        while (m < old.size() && old[m] < pairs[k]) ++m;
        if (m < old.size() && old[m] == pairs[k]) kept[k] = memory_[m];
    }
    memory_ = std::move(kept);
    pair_stiffness_.resize(pairs.size());
    for (std::size_t k = 0; k < pairs.size(); ++k)
        pair_stiffness_[k] = in_series(stiffness_[static_cast<std::size_t>(pairs[k].i)],
                                       stiffness_[static_cast<std::size_t>(pairs[k].j)]);
    pair_force_.assign(pairs.size(), Vec2::Zero());
    pair_shear_.assign(pairs.size(), 0.0);
    overlap_.assign(pairs.size(), 0.0);
    pair_dissipation_.assign(pairs.size(), 0.0);
    pair_damping_.assign(pairs.size(), 0.0);
}

void RigidDem::evaluate_forces(const WallMotion& walls, double dt) {
    const WallMotion cell = walls.flipped(flips_);
    if (law_.friction > 0.0) {
        evaluate_pairs<true>(cell, dt);
        gather_forces<true>(cell, dt);
    } else {
        evaluate_pairs<false>(cell, dt);
        gather_forces<false>(cell, dt);
    }
    if (box_.periodic) sum_virial();
}

template <bool with_friction>
void RigidDem::evaluate_pairs(const WallMotion& walls, double dt) {
    const auto pairs = neighbors_.pairs();
#pragma omp parallel for schedule(static) if (pairs.size() > worth_threads)
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto i = static_cast<std::size_t>(pairs[k].i);
        const auto j = static_cast<std::size_t>(pairs[k].j);
        const double stiffness = pair_stiffness_[k];
        Vec2 to_j = x_[j] - x_[i];
        if (walls.box.periodic) to_j += walls.box.image(neighbors_.images()[k]);
        const double reach = radius_[i] + radius_[j];
        ContactMemory& memory = memory_[k];
        pair_dissipation_[k] = 0.0;
        pair_damping_[k] = 0.0;
        const double distance2 = to_j.squaredNorm();
        if (distance2 >= reach * reach) {
            pair_force_[k].setZero();
            pair_shear_[k] = 0.0;
            overlap_[k] = 0.0;
            if constexpr (with_friction)  // a spring still stretched at separation is lost to friction
                pair_dissipation_[k] = 0.5 * memory.shear * memory.shear / (law_.shear_ratio * stiffness);
            memory = {};
            continue;
        }
        const double distance = std::sqrt(distance2);
        const Vec2 n = to_j / distance;
        const double overlap = reach - distance;
        overlap_[k] = overlap;
        Vec2 dv = v_[j] - v_[i];
        if (walls.box.periodic) dv += walls.image_velocity(neighbors_.images()[k]);
        const double closing = -dv.dot(n);
        const double effective_mass = mass_[i] * mass_[j] / (mass_[i] + mass_[j]);
        const NormalForce normal =
            normal_force(overlap, closing, stiffness, law_.damping_ratio, effective_mass);
        pair_damping_[k] = 0.5 * (memory.dashpot + normal.dashpot) * closing * dt;
        memory.dashpot = normal.dashpot;
        pair_force_[k] = -normal.total * n;
        if constexpr (with_friction) {
            const Vec2 s = perpendicular(n);
            const double slip = (dv.dot(s) - spin_[i] * (radius_[i] - 0.5 * overlap) -
                                 spin_[j] * (radius_[j] - 0.5 * overlap)) *
                                dt;
            const ShearForce shear =
                shear_force(memory.shear, slip, law_.shear_ratio * stiffness, law_.friction * normal.total);
            memory.shear = shear.force;
            pair_dissipation_[k] = shear.dissipated;
            pair_shear_[k] = shear.force;
            pair_force_[k] += shear.force * s;
        }
    }
}

template <bool with_friction>
void RigidDem::gather_forces(const WallMotion& walls, double dt) {
    // Each grain sums its own contacts in list order: the same bits for any number of threads.
#pragma omp parallel for schedule(static) if (x_.size() > worth_threads)
    for (std::size_t i = 0; i < x_.size(); ++i) {
        Vec2 force = Vec2::Zero();
        double torque = 0.0;
        double stiffness = 0.0;
        for (const PairsOfGrain::Entry entry : pairs_of_.of(i)) {
            const auto k = static_cast<std::size_t>(entry.pair);
            if (overlap_[k] <= 0.0) continue;
            force += entry.second ? Vec2(-pair_force_[k]) : pair_force_[k];
            stiffness += pair_stiffness_[k];
            if constexpr (with_friction) torque += (radius_[i] - 0.5 * overlap_[k]) * pair_shear_[k];
        }
        for (int w = 0; w < 4 && !walls.box.periodic; ++w) {
            const std::size_t c = 4 * i + static_cast<std::size_t>(w);
            const double overlap = radius_[i] - walls.box.distance(w, x_[i]);
            wall_overlap_[c] = overlap;
            if (overlap <= 0.0) {
                wall_normal_force_[c] = wall_dashpot_[c] = wall_damping_[c] = 0.0;
                continue;
            }
            const Vec2 inward = wall_normal(w);
            const double closing = -(v_[i] - walls.velocity_of(w)).dot(inward);
            const NormalForce normal =
                normal_force(overlap, closing, stiffness_[i], law_.damping_ratio, mass_[i]);
            wall_damping_[c] = 0.5 * (wall_dashpot_[c] + normal.dashpot) * closing * dt;
            wall_dashpot_[c] = normal.dashpot;
            wall_normal_force_[c] = normal.total;
            force += normal.total * inward;
            stiffness += 0.5 * stiffness_[i];  // nothing moves on the other side
        }
        force_[i] = force;
        torque_[i] = torque;
        // Gershgorin bound: each spring of a pair counts twice; a rotating disc (I = m R^2 / 2) adds its
        // tangential ones.
        const double rotation = with_friction ? 2.0 * law_.shear_ratio : 0.0;
        frequency2_[i] = 2.0 * stiffness * (1.0 + rotation) / mass_[i];
    }

    for (std::size_t w = 0; w < 4; ++w) {
        double sum = 0.0;
        for (std::size_t i = 0; i < x_.size(); ++i) sum += wall_normal_force_[4 * i + w];
        wall_force_[w] = -sum * wall_normal(static_cast<int>(w));
    }
}

double RigidDem::stable_time_step() const {
    double largest = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        // A grain must also survive its next two contacts.
        const double soon = 2.0 * 2.0 * in_series(stiffness_[i], largest_stiffness_) / mass_[i];
        largest = std::max({largest, frequency2_[i], soon});
    }
    const double zeta = law_.damping_ratio;
    return law_.safety * 2.0 / std::sqrt(largest) * (std::sqrt(1.0 + zeta * zeta) - zeta);
}

void RigidDem::account_energy(double dt) {
    double kinetic = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        // Velocity at the time of the positions, half a kick later.
        Vec2 v = v_[i] + force_[i] * (0.5 * dt / mass_[i]);
        if (box_.periodic) v -= walls_.affine_velocity(x_[i]);
        kinetic += 0.5 * mass_[i] * v.squaredNorm();
        if (law_.friction > 0.0) {
            const double inertia = 0.5 * mass_[i] * radius_[i] * radius_[i];
            const double spin = spin_[i] + torque_[i] * 0.5 * dt / inertia;
            kinetic += 0.5 * inertia * spin * spin;
        }
    }
    double elastic = 0.0;
    double damping = 0.0;
    double friction = 0.0;
    for (std::size_t k = 0; k < overlap_.size(); ++k) {
        if (overlap_[k] > 0.0) {
            elastic += 0.5 * pair_stiffness_[k] * overlap_[k] * overlap_[k];
            elastic += 0.5 * memory_[k].shear * memory_[k].shear / (law_.shear_ratio * pair_stiffness_[k]);
        }
        damping += pair_damping_[k];
        friction += pair_dissipation_[k];
    }
    for (std::size_t c = 0; c < wall_overlap_.size(); ++c) {
        if (wall_overlap_[c] > 0.0) elastic += 0.5 * stiffness_[c / 4] * wall_overlap_[c] * wall_overlap_[c];
        damping += wall_damping_[c];
    }
    energy_.kinetic = kinetic;
    energy_.elastic = elastic;
    energy_.damping += damping;
    energy_.friction += friction;
}

std::optional<std::string> RigidDem::outside_validity() const {
    const auto too_large = [&](double overlap, double radius) {
        return overlap > law_.overlap_limit * radius;
    };
    const auto tell = [&](std::size_t i, const std::string& partner, double relative) {
        return fmt::format("overlap of grain {} and {} is {:.3f} of the smaller radius (overlap_limit {})", i,
                           partner, relative, law_.overlap_limit);
    };
    const auto pairs = neighbors_.pairs();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        const auto i = static_cast<std::size_t>(pairs[k].i);
        const auto j = static_cast<std::size_t>(pairs[k].j);
        const double smaller = std::min(radius_[i], radius_[j]);
        if (too_large(overlap_[k], smaller))
            return tell(i, fmt::format("grain {}", j), overlap_[k] / smaller);
    }
    for (std::size_t c = 0; c < wall_overlap_.size(); ++c)
        if (too_large(wall_overlap_[c], radius_[c / 4]))
            return tell(c / 4, fmt::format("the {} wall", wall_names[c % 4]),
                        wall_overlap_[c] / radius_[c / 4]);
    return std::nullopt;
}

void RigidDem::check_finite() const {
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const auto bad = [&](const char* what) {
            return DivergedError(static_cast<int>(i), what, time_, "not a finite number");
        };
        if (!x_[i].allFinite()) throw bad("position");
        if (!v_[i].allFinite() || !std::isfinite(spin_[i])) throw bad("velocity");
        if (!force_[i].allFinite() || !std::isfinite(torque_[i])) throw bad("force");
    }
}

void RigidDem::set_velocity(std::span<const Vec2> velocity, std::span<const double> spin) {
    v_.assign(velocity.begin(), velocity.end());
    spin_.assign(spin.begin(), spin.end());
    account_energy(0.0);
}

}  // namespace softgrain::rigid_dem
