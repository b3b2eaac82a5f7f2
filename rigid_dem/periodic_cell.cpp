// Rigid DEM in a periodic cell: velocities against its flow, images, stress.
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

/// A change of the cell's motion moves all grains with it, so that it does not start at the boundary.
void RigidDem::carry_along(const WallMotion& walls) {
    for (std::size_t i = 0; i < x_.size(); ++i)
        v_[i] += walls.affine_velocity(x_[i]) - walls_.affine_velocity(x_[i]);
}

/// Grains go back into the cell; in the other image the flow has another velocity.
void RigidDem::wrap(const WallMotion& walls) {
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const Image image = walls.box.image_of(x_[i]);
        if (image == Image{}) continue;
        x_[i] -= walls.box.image(image);
        v_[i] -= walls.image_velocity(image);
    }
}

/// Velocity at the time of the positions, half a kick later, against the flow of the cell.
Mat2 RigidDem::kinetic_tensor(double dt) const {
    Mat2 sum = Mat2::Zero();
    for (std::size_t i = 0; i < x_.size(); ++i) {
        const Vec2 c = v_[i] + force_[i] * (0.5 * dt / mass_[i]) - walls_.affine_velocity(x_[i]);
        sum += mass_[i] * c * c.transpose();
    }
    return sum;
}

Vec2 RigidDem::branch(std::size_t pair) const {
    const Pair& p = neighbors_.pairs()[pair];
    const Vec2 direct = x_[static_cast<std::size_t>(p.j)] - x_[static_cast<std::size_t>(p.i)];
    return box_.periodic ? direct + box_.flipped(flips_).image(neighbors_.images()[pair]) : direct;
}

void RigidDem::sum_virial() {
    cell_virial_.setZero();
    for (std::size_t k = 0; k < overlap_.size(); ++k)
        if (overlap_[k] > 0.0) cell_virial_ -= pair_force_[k] * branch(k).transpose();
}

}  // namespace softgrain::rigid_dem
