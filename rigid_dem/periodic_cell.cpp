// Rigid DEM in a periodic cell: velocities against its flow, images.
#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {

/// None without a periodic cell.
Flow RigidDem::flow_of(const WallMotion& walls) const {
    if (!walls.box.periodic) return {};
    const Mat2 L = walls.velocity_gradient();
    const Vec2 origin = walls.box.origin();
    return {origin.x(), origin.y(), walls.velocity[0], walls.velocity[2], L(0, 0), L(0, 1), L(1, 1)};
}

/// A change of the cell's motion moves all grains with it, so that it does not start at the boundary.
void RigidDem::carry_along(const WallMotion& walls) {
    if (walls.velocity == walls_.velocity && walls.tilt_rate == walls_.tilt_rate) return;
    each_mover([&](std::size_t, GrainRecord& mover, const ForceSum&) {
        const Vec2 x{mover.x, mover.y};
        const Vec2 change = walls.affine_velocity(x) - walls_.affine_velocity(x);
        mover.vx += change.x();
        mover.vy += change.y();
    });
    if (clumps_) clumps_->place_discs(record_);
    walls_ = {box_, walls.velocity, walls.tilt_rate};
    kinetic_tensor_ = kinetic_tensor(last_dt_);
}

/// Grains go back into the cell; in the other image the flow has another velocity.
void RigidDem::wrap(const WallMotion& walls) {
    each_mover([&](std::size_t, GrainRecord& g, const ForceSum&) {
        const Image image = walls.box.image_of({g.x, g.y});
        if (image == Image{}) return;
        const Vec2 shift = walls.box.image(image), speed = walls.image_velocity(image);
        g.x -= shift.x();
        g.y -= shift.y();
        g.vx -= speed.x();
        g.vy -= speed.y();
    });
    if (clumps_) clumps_->place_discs(record_);
}

/// Velocity at the time of the positions, half a kick later, against the flow of the cell.
Mat2 RigidDem::kinetic_tensor(double dt) {
    const Flow flow = flow_of(walls_);
    if (flow.xx == 0.0 && flow.xy == 0.0 && flow.yy == 0.0) return Mat2::Zero();  // nothing works on it
    std::vector<std::array<double, 3>> parts(mover_blocks());
#pragma omp parallel for schedule(static) if (threads())
    for (std::size_t b = 0; b < parts.size(); ++b) {
        const MotionBlock block = movers(b);
        MotionSums sums{};
        add_kinetic_tensor(block.grain, block.force, block.grains, 0.5 * dt, flow, sums);
        parts[b] = {0.0, 0.0, 0.0};
        for (int l = 0; l < lanes; ++l) {
            parts[b][0] += sums.xx[l];
            parts[b][1] += sums.xy[l];
            parts[b][2] += sums.yy[l];
        }
    }
    Mat2 all = Mat2::Zero();
    for (const auto& [xx, xy, yy] : parts) all += (Mat2() << xx, xy, xy, yy).finished();
    return all;
}

}  // namespace softgrain::rigid_dem
