#include "rigid_dem/solver.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <numbers>

#include "common/errors.hpp"
#include "common/gravity.hpp"
#include "common/space_order.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr std::size_t worth_threads = 2 * grains_per_block;  ///< grains
constexpr long long steps_between_measures = 32;             ///< of the stability limit

double sum(const double (&by_lane)[lanes]) {
    double total = 0.0;
    for (const double one : by_lane) total += one;
    return total;
}

double largest(const double (&by_lane)[lanes]) {
    return *std::max_element(std::begin(by_lane), std::end(by_lane));
}

}  // namespace

RigidDem::RigidDem(const Scenario& scenario, const Packing& packing)
    : law_(parameters_of(scenario)),
      kernel_(pair_kernel(law_.hertz, law_.features, packing.box.periodic)),
      wall_kernel_(wall_kernel(law_.hertz, law_.features_at_walls)),
      uniform_(!law_.hertz && scenario.class_count() == 1),
      box_(packing.box),
      walls_{packing.box, {}, 0.0},
      gravity_(gravity_of(scenario, packing)),
      driven_(packing.driven),
      driven_start_(packing.center.begin() + static_cast<std::ptrdiff_t>(packing.free_size()),
                    packing.center.end()),
      driven_record_(packing.driven.size()),
      driven_force_(packing.driven.size()),
      thread_choice_(omp_get_max_threads()) {
    Packing discs_of_clumps;
    if (!packing.clumps.empty()) {
        if (!driven_.empty())
            throw InputError(
                "[[driven]] grains beside clumps are not for rigid_dem; take grains that are discs");
        if (law_.rest_tolerance > 0.0)
            throw InputError(
                "rigid_dem.rest_tolerance is not for clumps; take it out, or grains that are discs");
        clumps_ = std::make_unique<Clumps>(scenario, packing);
        discs_of_clumps = packing_of_discs(packing);
        law_.rotates = true;
    }
    const Packing& discs = clumps_ ? discs_of_clumps : packing;
    const std::size_t n = discs.size();
    radius_ = discs.radius;
    smallest_radius_ = *std::min_element(radius_.begin(), radius_.end());
    rest_ = RestingBlocks(law_.rest_tolerance * smallest_radius_);
    largest_radius_ = *std::max_element(radius_.begin(), radius_.end());
    for (std::size_t c = 0; c < scenario.class_count(); ++c) material_.push_back(scenario.material_of(c));
    if (material_.size() > 1)
        for (std::size_t g = 0; g < n; ++g)
            grain_class_.push_back(static_cast<std::uint8_t>(discs.class_of(g)));
    for (std::size_t g = 0; g < packing.size(); ++g) {
        const Material& material = scenario.material_of(packing.class_of(g));
        reference_area_.push_back(std::numbers::pi * packing.radius[g] * packing.radius[g]);
        if (!clumps_) mass_.push_back(material.density * reference_area_.back());
        if (g < packing.free_size())
            mean_modulus_ += material.youngs_modulus / static_cast<double>(packing.free_size());
    }
    for (std::size_t d = 0; clumps_ && d < n; ++d) mass_.push_back(clumps_->mass_at(d));
    std::vector<Vec2> x;
    for (const int g : space_order(discs.center, sorting_cell())) {
        x.push_back(discs.center[static_cast<std::size_t>(g)]);
        order_.push_back(static_cast<std::uint32_t>(g));
    }
    if (material_.size() == 1) mean_modulus_ = material_[0].youngs_modulus;
    flips_ = box_.periodic ? box_.flips() : 0;
    skin_ = skin_by_motion();
    list_neighbors(std::move(x));
    height_energy_at_start_ = height_energy();
    start_driven();
    evaluate_forces(walls_, 0.0);
    if (law_.bonds_of_start_only) law_.between_grains.sticks = 0.0;
    find_frequency();
}

GrainElasticity RigidDem::elasticity_of(std::size_t grain) const {
    const Material& material = material_[grain_class_.empty() ? 0 : grain_class_[grain]];
    return {radius_[grain], material.youngs_modulus, material.poisson_ratio};
}

bool RigidDem::threads() const {
    return radius_.size() > worth_threads && thread_choice_.parallel();
}

void RigidDem::advance(const WallMotion& walls, double dt) {
    const double began = omp_get_wtime();
    wake_pushed(walls);
    put_to_rest(walls, dt);
    if (box_.periodic) carry_along(walls);
    move(walls, dt);
    wake_touched(dt);
    box_ = walls.after(dt);
    walls_ = {box_, walls.velocity, walls.tilt_rate};
    time_ += dt;
    last_dt_ = dt;
    ++steps_listed_;
    if (list_is_stale()) list_again();

    const std::array<Vec2, 4> wall_force_before = wall_force_;
    const Mat2 pushed_before = cell_virial_ + kinetic_tensor_;
    const std::vector<ForceSum> driven_force_before = driven_force_;
    evaluate_forces(walls, dt);
    // Trapezoidal rule; walls and cell push with the opposite of what they feel.
    for (std::size_t w = 0; w < 4; ++w)
        dissipated_.external_work -=
            0.5 * (wall_force_[w] + wall_force_before[w]).dot(walls.velocity_of(static_cast<int>(w))) * dt;
    dissipated_.external_work +=
        0.5 * (driven_work(driven_force_before, dt) + driven_work(driven_force_, dt));
    if (box_.periodic) {
        const Mat2 before = pushed_before.cwiseProduct(walls.velocity_gradient());
        const Mat2 after = (cell_virial_ + kinetic_tensor_).cwiseProduct(walls_.velocity_gradient());
        dissipated_.external_work -= 0.5 * (before + after).sum() * dt;
    }
    if (++steps_measured_ >= steps_between_measures) find_frequency();
    if (radius_.size() > worth_threads) thread_choice_.note(omp_get_wtime() - began);
}

/// Blocks of what moves: grains, or clumps.
std::size_t RigidDem::mover_blocks() const {
    return clumps_ ? (clumps_->size() + grains_per_block - 1) / grains_per_block : blocks_.size();
}

MotionBlock RigidDem::movers(std::size_t b) {
    if (!clumps_) {
        const Block& block = blocks_[b];
        return {&record_[block.first_record],
                &force_[block.first_record],
                static_cast<int>(block.grains),
                law_.nonviscous_damping,
                law_.rotates,
                box_.periodic};
    }
    const std::size_t first = b * grains_per_block,
                      count = std::min(grains_per_block, clumps_->size() - first);
    return {&clumps_->bodies()[first],
            &clumps_->forces()[first],
            static_cast<int>(count),
            law_.nonviscous_damping,
            law_.rotates,
            box_.periodic};
}

void RigidDem::move(const WallMotion& walls, double dt) {
    const Flow flow = flow_of(walls);
    const double kick = last_dt_ > 0.0 ? 0.5 * (last_dt_ + dt) : dt;
    std::vector<std::pair<double, double>> totals(mover_blocks());  // squared speed, work
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < totals.size(); ++b) {
        if (rest_.resting(b)) continue;
        MotionSums sums{};
        kick_and_drift(movers(b), kick, dt, flow, sums);
        totals[b] = {largest(sums.speed2), sum(sums.work)};
        for (const double one : sums.speed2)
            if (std::isnan(one)) totals[b].first = one;
    }
    move_driven(time_, dt);
    fastest2_ = 0.0;
    for (const auto& [speed2, work] : totals) {
        if (!(speed2 <= fastest2_)) fastest2_ = speed2;
        dissipated_.damping += work;
        if (std::isnan(fastest2_)) break;
    }
    if (clumps_) fastest2_ = clumps_->turn(dt, flow, record_, threads());
    travelled_ += std::sqrt(fastest2_) * dt;
    if (!(fastest2_ * dt * dt < smallest_radius_ * smallest_radius_)) throw_too_fast(walls, dt);
}

/// If a grain has moved more than its radius against the flow.
void RigidDem::throw_too_fast(const WallMotion& walls, double dt) const {
    each_grain([&](std::size_t grain, std::size_t r) {
        const GrainRecord& g = record_[r];
        const Vec2 v{g.vx, g.vy}, x{g.x, g.y};
        const double moved = (box_.periodic ? Vec2(v - walls.affine_velocity(x)) : v).norm() * dt;
        if (!(moved < g.radius))
            throw DivergedError(static_cast<int>(owner(grain)), "velocity", time_,
                                fmt::format("it moves {:.3g} radii in one step", moved / g.radius));
    });
}

/// `walls` at the end of the step.
void RigidDem::evaluate_forces(const WallMotion& walls, double dt) {
    const WallMotion here{box_, walls.velocity, walls.tilt_rate};
    const WallMotion cell = here.flipped(flips_);
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        if (!rest_.resting(b)) totals_[b] = contact_forces(b, cell, dt);
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        if (!rest_.resting(b)) collect_arrivals(blocks_[b]);
    take_driven_forces();

    BlockTotals all;
    for (const BlockTotals& one : totals_) {
        all.virial += one.virial;
        all.friction_loss += one.friction_loss;
        all.damping_loss += one.damping_loss;
        all.adhesion_loss += one.adhesion_loss;
        all.overlap = std::max(all.overlap, one.overlap);
        for (std::size_t w = 0; w < 4; ++w) all.wall_force[w] += one.wall_force[w];
    }
    // From the branch between discs to that between clumps.
    if (clumps_) all.virial += clumps_->gather(record_, force_, gravity_, threads());
    cell_virial_ = -all.virial;
    wall_force_ = all.wall_force;
    largest_overlap_ = all.overlap;
    dissipated_.friction += all.friction_loss;
    dissipated_.damping += all.damping_loss;
    dissipated_.adhesion += all.adhesion_loss;
    if (box_.periodic) kinetic_tensor_ = kinetic_tensor(dt);
}

RigidDem::BlockTotals RigidDem::contact_forces(std::size_t b, const WallMotion& cell, double dt) {
    Block& block = blocks_[b];
    refresh_copies(block, cell);
    std::fill_n(force_.begin() + static_cast<std::ptrdiff_t>(block.first_record),
                block.grains + block.halo.size(), ForceSum{});
    start_with_weight(block);
    PairSums sums{};
    kernel_({.grain = &record_[block.first_record],
             .force = &force_[block.first_record],
             .pair = block.pairs.data(),
             .pairs = static_cast<int>(block.pairs.size()),
             .k = block.k.data(),
             .shear_ratio = block.shear_ratio.data(),
             .shear_compliance = block.shear_compliance.data(),
             .uniform = uniform_,
             .memory = {block.shear.data(), block.dashpot.data(), block.grip.data(), block.moment.data(),
                        block.bond.data()},
             .sums = &sums},
            law_.between_grains, dt);
    BlockTotals totals;
    totals.virial << sum(sums.virial_xx), sum(sums.virial_xy), sum(sums.virial_yx), sum(sums.virial_yy);
    totals.friction_loss = sum(sums.friction_loss);
    totals.damping_loss = sum(sums.damping_loss);
    totals.adhesion_loss = sum(sums.adhesion_loss);
    totals.overlap = largest(sums.overlap);
    if (!box_.periodic) {
        const WallSums at_walls = wall_kernel_(wall_contacts_[b], record_, force_, cell, law_.at_walls, dt);
        totals.wall_force = at_walls.force;
        totals.friction_loss += at_walls.friction_loss;
        totals.damping_loss += at_walls.damping_loss;
        totals.overlap = std::max(totals.overlap, at_walls.overlap);
    }
    return totals;
}

void RigidDem::start_with_weight(const Block& block) {
    if (gravity_.isZero(0.0) || clumps_) return;  // the weight of a clump acts at its centre
    for (std::size_t g = 0; g < block.grains; ++g) {
        const std::size_t grain = order_[block.first_grain + g];
        if (is_driven(grain)) continue;
        const Vec2 weight = mass_[grain] * gravity_;
        force_[block.first_record + g].fx = weight.x();
        force_[block.first_record + g].fy = weight.y();
    }
}

/// Copies follow their grains, in the image where this block sees them.
void RigidDem::refresh_copies(const Block& block, const WallMotion& cell) {
    for (std::size_t h = 0; h < block.halo.size(); ++h) {
        const Halo& halo = block.halo[h];
        GrainRecord copy = record_[halo.record];
        if (halo.image != Image{}) {
            const Vec2 shift = cell.box.image(halo.image), speed = cell.image_velocity(halo.image);
            copy.x += shift.x();
            copy.y += shift.y();
            copy.vx += speed.x();
            copy.vy += speed.y();
        }
        record_[block.first_record + block.grains + h] = copy;
    }
}

void RigidDem::collect_arrivals(const Block& block) {
    for (const Arrival& arrival : block.arrivals) {
        ForceSum& to = force_[block.first_record + arrival.grain];
        const ForceSum& from = force_[arrival.copy];
        to.fx += from.fx;
        to.fy += from.fy;
        to.shear += from.shear;
        to.lost_torque += from.lost_torque;
    }
}

std::optional<std::string> RigidDem::outside_validity() const {
    if (largest_overlap_ <= law_.overlap_limit * smallest_radius_) return std::nullopt;
    std::optional<std::string> found;
    const auto look = [&](std::size_t grain, const auto& partner, double overlap, double radius) {
        if (found || overlap <= law_.overlap_limit * radius) return;
        found = fmt::format("overlap of grain {} and {} is {:.3f} of the smaller radius (overlap_limit {})",
                            owner(grain), partner(), overlap / radius, law_.overlap_limit);
    };
    for (const Block& block : blocks_)
        each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
            look(
                std::min(i, j), [&] { return fmt::format("grain {}", owner(std::max(i, j))); },
                overlap(block, pair), std::min(radius_[i], radius_[j]));
        });
    if (found || box_.periodic) return found;
    each_grain([&](std::size_t grain, std::size_t r) {
        for (int w = 0; w < 4 && !is_driven(grain); ++w)
            look(
                grain, [&] { return fmt::format("the {} wall", wall_names[static_cast<std::size_t>(w)]); },
                wall_overlap(record_[r], w, box_), record_[r].radius);
    });
    return found;
}

void RigidDem::check_finite() const {
    each_grain([&](std::size_t grain, std::size_t r) {
        const auto check = [&](const char* what, auto... values) {
            if (!(std::isfinite(values) && ...))
                throw DivergedError(static_cast<int>(owner(grain)), what, time_, "not a finite number");
        };
        const GrainRecord& g = record_[r];
        const ForceSum& f = force_[r];
        check("position", g.x, g.y);
        check("velocity", g.vx, g.vy, g.spin);
        check("force", f.fx, f.fy, f.shear, f.lost_torque);
    });
}

void RigidDem::set_velocity(std::span<const Vec2> velocity, std::span<const double> spin) {
    each_mover([&](std::size_t g, GrainRecord& mover, const ForceSum&) {
        mover.vx = velocity[g].x();
        mover.vy = velocity[g].y();
        mover.spin = spin[g];
        mover.rim_speed = mover.spin * mover.radius;
    });
    if (clumps_) clumps_->place_discs(record_);
    last_dt_ = 0.0;
    start_rest();
    evaluate_forces(walls_, 0.0);
}

}  // namespace softgrain::rigid_dem
