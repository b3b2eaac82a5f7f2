// Complete state of rigid DEM: what is not here is recomputed from it with the same bits.
#include "common/errors.hpp"
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

void RigidDem::save(Checkpoint& to) const {
    to.put("box", std::span<const double>(box_.position));
    to.put("cell", std::vector<double>{box_.tilt, static_cast<double>(flips_)});
    to.put("walls_velocity", std::vector<double>{walls_.velocity[0], walls_.velocity[1], walls_.velocity[2],
                                                 walls_.velocity[3], walls_.tilt_rate});
    const Box& built = neighbors_.built_cell();
    to.put("built_cell", std::vector<double>{built.position[0], built.position[1], built.position[2],
                                             built.position[3], built.tilt});
    to.put("virials", std::vector<Mat2>{cell_virial_, kinetic_tensor_});
    to.put("time", time_);
    to.put("x", x_);
    to.put("v", v_);
    to.put("spin", spin_);
    to.put("force", force_);
    to.put("torque", torque_);
    to.put("frequency2", frequency2_);
    to.put("built_at", neighbors_.built_at());
    to.put("overlap", overlap_);
    to.put("pair_force", pair_force_);
    to.put("pair_shear", pair_shear_);
    std::vector<double> memory;
    for (const ContactMemory& m : memory_) memory.insert(memory.end(), {m.shear, m.dashpot});
    to.put("memory", memory);
    to.put("wall_overlap", wall_overlap_);
    to.put("wall_normal_force", wall_normal_force_);
    to.put("wall_dashpot", wall_dashpot_);
    to.put("wall_force", std::span<const Vec2>(wall_force_));
    to.put("energy", std::vector<double>{energy_.kinetic, energy_.elastic, energy_.external_work,
                                         energy_.damping, energy_.friction});
}

void RigidDem::load(const Checkpoint& from) {
    std::vector<double> values;
    const auto read = [&](std::string_view name, auto& into, std::size_t size) {
        from.get(name, into);
        if (into.size() != size)
            throw InputError("checkpoint array '" + std::string(name) + "' does not fit this packing");
    };
    const std::size_t n = radius_.size();
    read("box", values, 4);
    std::copy(values.begin(), values.end(), box_.position.begin());
    time_ = from.number("time");
    std::vector<Vec2> built_at;
    read("built_at", built_at, n);
    neighbors_ = {};
    x_ = built_at;
    read("built_cell", values, 5);
    const Box cell = box_;
    std::copy(values.begin(), values.begin() + 4, box_.position.begin());
    box_.tilt = values[4];
    flips_ = 0;
    list_neighbors();
    box_ = cell;
    read("cell", values, 2);
    box_.tilt = values[0];
    flips_ = static_cast<int>(values[1]);
    read("walls_velocity", values, 5);
    walls_ = {box_, {values[0], values[1], values[2], values[3]}, values[4]};
    std::vector<Mat2> virials;
    read("virials", virials, 2);
    cell_virial_ = virials[0];
    kinetic_tensor_ = virials[1];
    read("x", x_, n);
    read("v", v_, n);
    read("spin", spin_, n);
    read("force", force_, n);
    read("torque", torque_, n);
    read("frequency2", frequency2_, n);
    const std::size_t pairs = neighbors_.pairs().size();
    read("overlap", overlap_, pairs);
    read("pair_force", pair_force_, pairs);
    read("pair_shear", pair_shear_, pairs);
    read("memory", values, 2 * pairs);
    for (std::size_t k = 0; k < pairs; ++k) memory_[k] = {values[2 * k], values[2 * k + 1]};
    read("wall_overlap", wall_overlap_, 4 * n);
    read("wall_normal_force", wall_normal_force_, 4 * n);
    read("wall_dashpot", wall_dashpot_, 4 * n);
    std::vector<Vec2> wall_force;
    read("wall_force", wall_force, 4);
    std::copy(wall_force.begin(), wall_force.end(), wall_force_.begin());
    read("energy", values, 5);
    energy_ = {values[0], values[1], values[2], values[3], values[4], 0.0};
}

}  // namespace softgrain::rigid_dem
