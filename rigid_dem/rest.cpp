// Blocks whose grains are at rest are neither moved nor asked for forces; their own forces, and those that
// they leave for others, stay as they were.
#include <cmath>

#include "common/errors.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

void RigidDem::start_rest() {
    if (!rest_.used()) return;
    std::vector<std::vector<std::uint32_t>> neighbors(blocks_.size());
    for (std::size_t b = 0; b < blocks_.size(); ++b)
        for (const Halo& copy : blocks_[b].halo) {
            const std::size_t home = block_of(copy.record);
            if (home == b) continue;
            neighbors[b].push_back(static_cast<std::uint32_t>(home));
            neighbors[home].push_back(static_cast<std::uint32_t>(b));
        }
    for (auto& of_block : neighbors) {
        std::sort(of_block.begin(), of_block.end());
        of_block.erase(std::unique(of_block.begin(), of_block.end()), of_block.end());
    }
    rest_.start(std::move(neighbors));
}

/// True if the cell, a driven grain of the block, or a wall that a grain touches or may soon touch, moves.
bool RigidDem::is_pushed(std::size_t b, const WallMotion& walls) const {
    if (blocks_[b].is_driven) return true;
    if (box_.periodic)
        return walls.tilt_rate != 0.0 ||
               std::any_of(walls.velocity.begin(), walls.velocity.end(), [](double v) { return v != 0.0; });
    return std::any_of(wall_contacts_[b].begin(), wall_contacts_[b].end(),
                       [&](const WallContact& contact) { return walls.velocity[contact.wall] != 0.0; });
}

void RigidDem::wake_pushed(const WallMotion& walls) {
    for (std::size_t b = 0; rest_.used() && b < blocks_.size(); ++b)
        if (rest_.resting(b) && is_pushed(b, walls)) rest_.wake(b);
}

/// Tells what has moved, and wakes what is beside it.
void RigidDem::wake_touched(double dt) {
    if (!rest_.used()) return;
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        if (rest_.resting(b)) continue;
        double speed2 = 0.0, rim = 0.0;
        for (std::size_t g = 0; g < blocks_[b].grains; ++g) {
            const GrainRecord& grain = record(blocks_[b], g);
            speed2 = std::max(speed2, grain.vx * grain.vx + grain.vy * grain.vy);
            rim = std::max(rim, std::abs(grain.rim_speed));
        }
        rest_.moved(b, (std::sqrt(speed2) + rim) * dt);
    }
    rest_.wake_beside_motion();
}

/// True if the forces on the grains of a block balance.
bool RigidDem::is_balanced(const Block& block, double largest_acceleration) const {
    for (std::size_t g = 0; g < block.grains; ++g) {
        const GrainRecord& grain = record(block, g);
        const ForceSum& force = force_[block.first_record + g];
        const double torque = grain.radius * force.shear - force.lost_torque;
        const double at_rim = law_.rotates ? 2.0 * std::abs(torque) / grain.radius : 0.0;
        if (!((std::sqrt(force.fx * force.fx + force.fy * force.fy) + at_rim) * grain.inverse_mass <=
              largest_acceleration))
            return false;
    }
    return true;
}

/// Blocks that have been slow and are balanced lose what motion they have. Before a step and not after one: a
/// restart finds forces by the velocities that are saved.
void RigidDem::put_to_rest(const WallMotion& walls, double dt) {
    if (!rest_.used()) return;
    const double largest_acceleration = rest_.largest_acceleration(gravity_, dt);
    std::vector<double> lost(blocks_.size(), 0.0);  // [J]
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        if (!rest_.slow(b) || is_pushed(b, walls) || !is_balanced(block, largest_acceleration)) continue;
        rest_.put_to_rest(b);
        totals_[b].friction_loss = totals_[b].damping_loss = totals_[b].adhesion_loss = 0.0;
        for (std::size_t g = 0; g < block.grains; ++g) {
            GrainRecord& grain = record_[block.first_record + g];
            if (grain.inverse_mass > 0.0)
                lost[b] += (0.5 * (grain.vx * grain.vx + grain.vy * grain.vy) +
                            0.25 * grain.rim_speed * grain.rim_speed) /
                           grain.inverse_mass;
            grain.vx = grain.vy = grain.spin = grain.rim_speed = 0.0;
        }
    }
    for (const double one : lost) dissipated_.damping += one;
}

template <class Self, class Visit>
void RigidDem::each_kept_value(Self& solver, const Visit& visit) {
    for (std::size_t b = 0; b < solver.blocks_.size(); ++b) {
        if (!solver.rest_.resting(b)) continue;
        const Block& block = solver.blocks_[b];
        const std::size_t copies = block.first_record + block.grains, end = copies + block.halo.size();
        for (std::size_t r = block.first_record; r < end; ++r) {
            auto& force = solver.force_[r];
            for (auto* value : {&force.fx, &force.fy, &force.shear, &force.lost_torque}) visit(*value);
        }
        for (std::size_t r = copies; r < end; ++r) {
            auto& copy = solver.record_[r];
            for (auto* value : {&copy.x, &copy.y, &copy.vx, &copy.vy, &copy.spin, &copy.radius,
                                &copy.rim_speed, &copy.inverse_mass})
                visit(*value);
        }
        auto& totals = solver.totals_[b];
        for (int k = 0; k < 4; ++k) visit(totals.virial(k / 2, k % 2));
        for (auto& force : totals.wall_force)
            for (int k = 0; k < 2; ++k) visit(force[k]);
        for (auto* value :
             {&totals.overlap, &totals.friction_loss, &totals.damping_loss, &totals.adhesion_loss})
            visit(*value);
    }
}

std::vector<double> RigidDem::kept_at_rest() const {
    std::vector<double> kept;
    each_kept_value(*this, [&](double value) { kept.push_back(value); });
    return kept;
}

/// As kept_at_rest() gives it, after the same blocks have been put to rest.
void RigidDem::set_kept_at_rest(const std::vector<double>& kept) {
    std::size_t size = 0;
    each_kept_value(*this, [&](double) { ++size; });
    if (kept.size() != size) throw InputError("checkpoint array 'kept_at_rest' does not fit this packing");
    auto next = kept.begin();
    each_kept_value(*this, [&](double& value) { value = *next++; });
}

}  // namespace softgrain::rigid_dem
