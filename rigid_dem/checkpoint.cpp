// Complete state of rigid DEM: what is not here is found again from it with the same bits.
#include "common/errors.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

void put_wall(std::vector<double>& to, const ContactMemory& m) {
    to.insert(to.end(), {m.shear, m.dashpot, m.grip, m.moment, m.bond});
}

}  // namespace

void RigidDem::save(Checkpoint& to) const {
    to.put("box", std::span<const double>(box_.position));
    to.put("cell", std::vector<double>{box_.tilt, static_cast<double>(flips_)});
    to.put("walls_velocity", std::vector<double>{walls_.velocity[0], walls_.velocity[1], walls_.velocity[2],
                                                 walls_.velocity[3], walls_.tilt_rate});
    const Box& built = neighbors_.built_cell();
    to.put("built_cell", std::vector<double>{built.position[0], built.position[1], built.position[2],
                                             built.position[3], built.tilt});
    to.put("virials", std::vector<Mat2>{cell_virial_, kinetic_tensor_});
    to.put("scalars", std::vector<double>{time_, last_dt_, skin_, travelled_, frequency2_, fastest2_,
                                          law_.between_grains.sticks});
    to.put("counters", std::vector<std::int64_t>{listings_, steps_listed_, steps_measured_});
    to.put("order", std::vector<std::int64_t>(order_.begin(), order_.end()));
    to.put("built_at", neighbors_.built_at());
    std::vector<double> state;
    each_grain([&](std::size_t, std::size_t r) {
        const GrainRecord& g = record_[r];
        state.insert(state.end(), {g.x, g.y, g.vx, g.vy, g.spin});
    });
    to.put("state", state);
    if (clumps_) {
        std::vector<double> clumps;
        for (std::size_t g = 0; g < clumps_->size(); ++g) {
            const ClumpState s = clumps_->state(g);
            clumps.insert(clumps.end(), {s.x, s.y, s.vx, s.vy, s.spin, s.angle});
        }
        to.put("clumps", clumps);
    }
    std::vector<double> memory, at_walls;
    for (const Block& block : blocks_)
        for (const auto array : memories)
            memory.insert(memory.end(), (block.*array).begin(), (block.*array).end());
    for (const auto& contacts : wall_contacts_)
        for (const WallContact& contact : contacts) put_wall(at_walls, contact.memory);
    to.put("memory", memory);
    to.put("wall_memory", at_walls);
    to.put("wall_force", std::span<const Vec2>(wall_force_));
    std::vector<double> driven;
    for (const ForceSum& f : driven_force_) driven.insert(driven.end(), {f.fx, f.fy, f.shear, f.lost_torque});
    to.put("driven_force", driven);
    if (rest_.used()) {
        rest_.save(to);
        to.put("kept_at_rest", kept_at_rest());
    }
    to.put("energy", std::vector<double>{dissipated_.external_work, dissipated_.damping, dissipated_.friction,
                                         dissipated_.adhesion});
}

/// As save() puts it.
void RigidDem::remember(const std::vector<double>& memory, const std::vector<double>& at_walls) {
    auto next = memory.begin();
    for (Block& block : blocks_)
        for (const auto array : memories)
            for (double& one : block.*array) one = *next++;
    next = at_walls.begin();
    for (auto& contacts : wall_contacts_)
        for (WallContact& contact : contacts) {
            ContactMemory& m = contact.memory;
            for (double* one : {&m.shear, &m.dashpot, &m.grip, &m.moment, &m.bond}) *one = *next++;
        }
}

void RigidDem::load(const Checkpoint& from) {
    const auto read = [&](std::string_view name, auto& into, std::size_t size) {
        from.get(name, into);
        if (into.size() != size)
            throw InputError("checkpoint array '" + std::string(name) + "' does not fit this packing");
    };
    const std::size_t n = radius_.size();
    std::vector<double> values;
    read("built_cell", values, 5);
    std::copy(values.begin(), values.begin() + 4, box_.position.begin());
    box_.tilt = values[4];
    flips_ = 0;
    read("scalars", values, 7);
    time_ = values[0];
    last_dt_ = values[1];
    skin_ = values[2];
    const std::vector<double> scalars = values;
    std::vector<std::int64_t> order;
    read("order", order, n);
    std::vector<Vec2> built_at;
    read("built_at", built_at, n);
    for (std::size_t s = 0; s < n; ++s) {
        if (order[s] < 0 || static_cast<std::size_t>(order[s]) >= n)
            throw InputError("checkpoint array 'order' does not fit this packing");
        order_[s] = static_cast<std::uint32_t>(order[s]);
    }
    list_neighbors(std::move(built_at));

    read("state", values, 5 * n);
    std::size_t next = 0;
    each_grain([&](std::size_t, std::size_t r) {
        GrainRecord& g = record_[r];
        for (double* value : {&g.x, &g.y, &g.vx, &g.vy, &g.spin}) *value = values[next++];
        g.rim_speed = g.spin * g.radius;
    });
    if (clumps_) {
        read("clumps", values, 6 * clumps_->size());
        for (std::size_t g = 0; g < clumps_->size(); ++g) {
            const double* const s = &values[6 * g];
            clumps_->set_state(g, {s[0], s[1], s[2], s[3], s[4], s[5]});
        }
    }
    std::size_t size = 0;
    for (const Block& block : blocks_)
        for (const auto array : memories) size += (block.*array).size();
    std::vector<double> memory, at_walls;
    read("memory", memory, size);
    size = 0;
    for (const auto& contacts : wall_contacts_) size += 5 * contacts.size();
    read("wall_memory", at_walls, size);

    read("box", values, 4);
    std::copy(values.begin(), values.end(), box_.position.begin());
    read("cell", values, 2);
    box_.tilt = values[0];
    flips_ = static_cast<int>(values[1]);
    read("walls_velocity", values, 5);
    walls_ = {box_, {values[0], values[1], values[2], values[3]}, values[4]};
    law_.between_grains.sticks = scalars[6];
    remember(memory, at_walls);
    if (rest_.used()) {
        rest_.load(from);
        from.get("kept_at_rest", values);
        set_kept_at_rest(values);
    }
    evaluate_forces(walls_, 0.0);
    remember(memory, at_walls);  // an evaluation makes 0 of -0

    travelled_ = scalars[3];
    frequency2_ = scalars[4];
    fastest2_ = scalars[5];
    std::vector<std::int64_t> counters;
    read("counters", counters, 3);
    listings_ = static_cast<int>(counters[0]);
    steps_listed_ = counters[1];
    steps_measured_ = counters[2];
    std::vector<Mat2> virials;
    read("virials", virials, 2);
    cell_virial_ = virials[0];
    kinetic_tensor_ = virials[1];
    std::vector<Vec2> wall_force;
    read("wall_force", wall_force, 4);
    std::copy(wall_force.begin(), wall_force.end(), wall_force_.begin());
    read("driven_force", values, 4 * driven_force_.size());
    next = 0;
    for (ForceSum& f : driven_force_)
        for (double* one : {&f.fx, &f.fy, &f.shear, &f.lost_torque}) *one = values[next++];
    read("energy", values, 4);
    dissipated_.external_work = values[0];
    dissipated_.damping = values[1];
    dissipated_.friction = values[2];
    dissipated_.adhesion = values[3];
}

}  // namespace softgrain::rigid_dem
