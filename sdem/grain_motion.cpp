#include "sdem/grain_motion.hpp"

#include "sdem/laws/mollon2022.hpp"

namespace softgrain::sdem {
namespace {

/// v(x) = v + L (x - x0)
struct AffineFlow {
    Vec2 v, x0;
    Mat2 L;

    AffineFlow(const WallMotion& cell, const Box& box)
        : v(cell.velocity[0], cell.velocity[2]), x0(box.origin()), L(cell.velocity_gradient()) {}
};

/// Velocities of the block follow the change of the flow; finds their flux.
void follow_flow(MotionBlock& block, const AffineFlow& last, const AffineFlow& now) {
    const Mat2 change = now.L - last.L;
    const Vec2 jump = now.v - last.v;
    block.flux = Tensor{0.0, 0.0, 0.0, 0.0};
    for (int l = 0; l < block.count; ++l) {
        const double rx = block.x[l] - now.x0.x(), ry = block.y[l] - now.x0.y();
        block.flow_vx[l] = now.v.x() + (now.L(0, 0) * rx + now.L(0, 1) * ry);
        block.flow_vy[l] = now.v.y() + (now.L(1, 0) * rx + now.L(1, 1) * ry);
        block.vx[l] += jump.x() + (change(0, 0) * rx + change(0, 1) * ry);
        block.vy[l] += jump.y() + (change(1, 0) * rx + change(1, 1) * ry);
        const double ux = block.vx[l] - block.flow_vx[l], uy = block.vy[l] - block.flow_vy[l];
        block.flux = block.flux + block.mass[l] * Tensor{ux * ux, ux * uy, uy * ux, uy * uy};
    }
}

void load_block(MotionBlock& block, const MotionInput& in, const Grains& grains, const GrainMemory& memory,
                std::size_t begin, std::size_t end) {
    block.count = static_cast<int>(end - begin);
    for (std::size_t g = begin; g < end; ++g) {
        const auto l = static_cast<int>(g - begin);
        const Grain& grain = grains.grain[g];
        const GrainMaterial& material = grains.material_of(g);
        const GrainSums sums = sum_contacts(in.forces, g);
        block.x[l] = grain.x;
        block.y[l] = grain.y;
        block.vx[l] = grain.vx;
        block.vy[l] = grain.vy;
        block.F.set(l, grain.F);
        block.F_rate.set(l, grain.F_rate);
        block.a[l] = grain.a;
        block.b[l] = grain.b;
        block.mass[l] = grain.mass;
        block.inertia_x[l] = 0.25 * grain.mass * grain.a * grain.a;
        block.inertia_y[l] = 0.25 * grain.mass * grain.b * grain.b;
        block.area[l] = grain.reference_area();
        block.mu[l] = material.mu;
        block.kappa[l] = material.kappa;
        block.damping_rate[l] = material.shape_damping / grain.radius;
        block.dilation_inertia[l] = material.dilation_inertia;
        block.yield[l] = material.yield;
        block.fx[l] = sums.fx + grain.mass * in.law.gravity.x();
        block.fy[l] = sums.fy + grain.mass * in.law.gravity.y();
        block.damping_fx[l] = sums.damping_fx;
        block.damping_fy[l] = sums.damping_fy;
        block.moment.set(l, sums.moment);
        block.damping_moment.set(l, sums.damping_moment);
        if (in.law.contact_law == ContactLaw::lens_potential) {
            block.moment.xx[l] -= sums.pressed;
            block.moment.yy[l] -= sums.pressed;
            block.pressure[l] = in.stress[g];
        } else {
            block.caps[l] = Mollon2022::cap_fraction(sums.caps, covered_outline(in.forces.contacts.list, g),
                                                     block.area[l]);
        }
        if (in.law.imposes_area) block.caps_before[l] = memory.caps_before[g];
        if (in.law.plastic) {
            block.plastic_xx[l] = memory.plastic_xx[g];
            block.plastic_xy[l] = memory.plastic_xy[g];
            block.plastic_yy[l] = memory.plastic_yy[g];
        }
    }
    if (in.flow.box.periodic) {
        follow_flow(block, AffineFlow(in.last_flow, in.flow.box), AffineFlow(in.flow, in.flow.box));
    } else {
        std::fill_n(block.flow_vx, block.count, 0.0);
        std::fill_n(block.flow_vy, block.count, 0.0);
    }
}

/// Inner stress and the kick; the block is then ready to drift.
void kick_block(MotionBlock& block, const MotionInput& in, const Grains& grains, const GrainMemory& memory,
                const StepTimes& times, std::size_t begin, std::size_t end) {
    load_block(block, in, grains, memory, begin, end);
    add_inner_stress(block, in.law);
    kick(block, in.law, times);
}

void keep_flow(const MotionBlock& block, GrainMemory& memory, std::size_t g, int l) {
    memory.plastic_xx[g] = block.plastic_xx[l];
    memory.plastic_xy[g] = block.plastic_xy[l];
    memory.plastic_yy[g] = block.plastic_yy[l];
}

StepWork work_of(const MotionBlock& block, const MotionInput& in) {
    StepWork work;
    if (in.flow.box.periodic) work.flux = block.flux;
    for (int l = 0; l < block.count; ++l) {
        work.stored += block.stored[l];
        work.damped += block.damped[l];
        work.kinetic += block.kinetic[l];
        if (in.law.plastic) work.plastic += block.plastic_work[l];
    }
    return work;
}

}  // namespace

StepWork move_grains(const MotionInput& in, Grains& grains, GrainMemory& memory, const StepTimes& times,
                     std::size_t begin, std::size_t end, std::size_t& bad) {
    MotionBlock block;
    kick_block(block, in, grains, memory, times, begin, end);
    drift(block, in.law, times.next_drift);
    for (std::size_t g = begin; g < end; ++g) {
        const auto l = static_cast<int>(g - begin);
        Grain& grain = grains.grain[g];
        grain.x = block.x[l];
        grain.y = block.y[l];
        grain.F = block.F[l];
        grain.vx = block.vx[l];
        grain.vy = block.vy[l];
        grain.F_rate = block.F_rate[l];
        grains.next_center[g] = Vec2{grain.x, grain.y};
        grains.reach[g] = block.reach[l];
        if (in.law.imposes_area) memory.caps_before[g] = block.caps_before[l];
        if (in.law.plastic) keep_flow(block, memory, g, l);
        if (!sound(grain, block.moved[l], block.det[l], block.reach[l])) bad = std::min(bad, g);
    }
    return work_of(block, in);
}

StepWork kick_work(const MotionInput& in, const Grains& grains, const GrainMemory& memory,
                   const StepTimes& times, std::size_t begin, std::size_t end) {
    MotionBlock block;
    kick_block(block, in, grains, memory, times, begin, end);
    return work_of(block, in);
}

void kick_from_rest(MotionBlock& block, const MotionInput& in, const Grains& grains,
                    const GrainMemory& memory, std::size_t begin, std::size_t end) {
    load_block(block, in, grains, memory, begin, end);
    for (int l = 0; l < block.count; ++l) {
        block.vx[l] = block.vy[l] = 0.0;
        block.F_rate.set(l, Tensor{0.0, 0.0, 0.0, 0.0});
    }
    add_inner_stress(block, in.law);
    kick(block, in.law, {0.0, 1.0, 0.0});
}

double flow_grains(const MotionInput& in, const Grains& grains, GrainMemory& memory, std::size_t begin,
                   std::size_t end) {
    MotionBlock block;
    load_block(block, in, grains, memory, begin, end);
    add_inner_stress(block, in.law);
    double work = 0.0;
    for (std::size_t g = begin; g < end; ++g) {
        const auto l = static_cast<int>(g - begin);
        keep_flow(block, memory, g, l);
        work += block.plastic_work[l];
    }
    return work;
}

}  // namespace softgrain::sdem
