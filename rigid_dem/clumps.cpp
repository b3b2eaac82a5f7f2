#include "rigid_dem/clumps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace softgrain::rigid_dem {
namespace {

std::size_t blocks_of(std::size_t clumps) {
    return (clumps + grains_per_block - 1) / grains_per_block;
}

}  // namespace

Packing packing_of_discs(const Packing& packing) {
    Packing all;
    all.box = packing.box;
    for (std::size_t g = 0; g < packing.size(); ++g)
        for (const Disc& disc : packing.discs_of(g)) {
            all.center.push_back(disc.center);
            all.radius.push_back(disc.radius);
            if (!packing.grain_class.empty()) all.grain_class.push_back(packing.grain_class[g]);
        }
    return all;
}

Clumps::Clumps(const Scenario& scenario, const Packing& packing)
    : radius_(packing.radius), angle_(packing.size()), direction_(packing.size()), shapes_(packing.clumps) {
    first_.push_back(0);
    for (std::size_t g = 0; g < packing.size(); ++g) {
        set_angle(g, packing.angle[g]);
        const std::size_t c = packing.class_of(g);
        const ClumpShape& shape = shapes_[c];
        const double R = radius_[g], density = scenario.material_of(c).density;
        mass_.push_back(density * std::numbers::pi * R * R);
        inertia_.push_back(density * shape.polar_moment * R * R * R * R);
        reach_.push_back(R * shape.reach);
        shape_.push_back(static_cast<std::uint8_t>(c));
        body_.push_back({.x = packing.center[g].x(),
                         .y = packing.center[g].y(),
                         .radius = std::sqrt(2.0 * inertia_[g] / mass_[g]),
                         .inverse_mass = 1.0 / mass_[g]});
        for (const Disc& disc : shape.discs) {
            arm_.push_back(R * disc.center);
            owner_.push_back(static_cast<std::uint32_t>(g));
        }
        first_.push_back(static_cast<std::uint32_t>(owner_.size()));
    }
    largest_reach_ = *std::max_element(reach_.begin(), reach_.end());
    force_.resize(size());
    record_of_.resize(discs());
}

double Clumps::mass_at(std::size_t disc) const {
    const std::size_t g = owner_[disc];
    return 1.0 / (1.0 / mass_[g] + arm_[disc].squaredNorm() / inertia_[g]);
}

Vec2 Clumps::arm_now(std::size_t disc) const {
    const Vec2& along = direction_[owner_[disc]];
    return along * arm_[disc].x() + perpendicular(along) * arm_[disc].y();
}

void Clumps::find_discs(std::span<const std::uint32_t> order, std::span<const Block> blocks) {
    for (const Block& block : blocks)
        for (std::size_t k = 0; k < block.grains; ++k)
            record_of_[order[block.first_grain + k]] = static_cast<std::uint32_t>(block.first_record + k);
}

Mat2 Clumps::gather(std::span<const GrainRecord> record, std::span<const ForceSum> force, const Vec2& gravity,
                    bool threads) {
    std::vector<Mat2> by_block(blocks_of(size()), Mat2::Zero());
#pragma omp parallel for schedule(static) if (threads)
    for (std::size_t b = 0; b < by_block.size(); ++b)
        for (std::size_t g = b * grains_per_block; g < std::min(size(), (b + 1) * grains_per_block); ++g) {
            Vec2 total = mass_[g] * gravity;
            double torque = 0.0;
            for (std::size_t d = first_[g]; d < first_[g + 1]; ++d) {
                const GrainRecord& disc = record[record_of_[d]];
                const ForceSum& sum = force[record_of_[d]];
                const Vec2 arm{disc.x - body_[g].x, disc.y - body_[g].y}, f{sum.fx, sum.fy};
                total += f;
                torque += cross(arm, f) + disc.radius * sum.shear - sum.lost_torque;
                by_block[b] += f * arm.transpose();
            }
            force_[g] = {total.x(), total.y(), 0.0, -torque};
        }
    Mat2 all = Mat2::Zero();
    for (const Mat2& one : by_block) all += one;
    return all;
}

double Clumps::turn(double dt, const Flow& flow, std::span<GrainRecord> record, bool threads) {
    // How fast the flow itself changes along an arm.
    const double flow_rate = std::hypot(flow.xx, flow.xy, flow.yy);
    std::vector<double> fastest2(blocks_of(size()), 0.0);
#pragma omp parallel for schedule(static) if (threads)
    for (std::size_t b = 0; b < fastest2.size(); ++b)
        for (std::size_t g = b * grains_per_block; g < std::min(size(), (b + 1) * grains_per_block); ++g) {
            const GrainRecord& body = body_[g];
            set_angle(g, angle_[g] + body.spin * dt);
            place_discs_of(g, record);
            const double dx = body.x - flow.origin_x, dy = body.y - flow.origin_y;
            const double cx = body.vx - flow.origin_vx - flow.xx * dx - flow.xy * dy;
            const double cy = body.vy - flow.origin_vy - flow.yy * dy;
            const double speed = std::hypot(cx, cy) + (std::abs(body.spin) + flow_rate) * reach_[g];
            if (!(speed * speed <= fastest2[b]) && !std::isnan(fastest2[b])) fastest2[b] = speed * speed;
        }
    double most = 0.0;
    for (const double one : fastest2)
        if (!(one <= most) && !std::isnan(most)) most = one;
    return most;
}

void Clumps::place_discs(std::span<GrainRecord> record) const {
    for (std::size_t g = 0; g < size(); ++g) place_discs_of(g, record);
}

void Clumps::place_discs_of(std::size_t g, std::span<GrainRecord> record) const {
    const GrainRecord& body = body_[g];
    for (std::size_t d = first_[g]; d < first_[g + 1]; ++d) {
        const Vec2 arm = arm_now(d);
        GrainRecord& disc = record[record_of_[d]];
        disc.x = body.x + arm.x();
        disc.y = body.y + arm.y();
        disc.vx = body.vx - body.spin * arm.y();
        disc.vy = body.vy + body.spin * arm.x();
        disc.spin = body.spin;
        disc.rim_speed = body.spin * disc.radius;
    }
}

std::vector<Vec2> Clumps::outline(std::size_t g) const {
    std::vector<Vec2> points;
    for (const Vec2& p : shapes_[shape_[g]].outline)
        points.push_back(Vec2{body_[g].x, body_[g].y} +
                         radius_[g] * (direction_[g] * p.x() + perpendicular(direction_[g]) * p.y()));
    return points;
}

ClumpState Clumps::state(std::size_t g) const {
    return {body_[g].x, body_[g].y, body_[g].vx, body_[g].vy, body_[g].spin, angle_[g]};
}

void Clumps::set_state(std::size_t g, const ClumpState& state) {
    GrainRecord& body = body_[g];
    body.x = state.x;
    body.y = state.y;
    body.vx = state.vx;
    body.vy = state.vy;
    body.spin = state.spin;
    body.rim_speed = state.spin * body.radius;
    set_angle(g, state.angle);
}

void Clumps::set_angle(std::size_t g, double angle) {
    angle_[g] = angle;
    direction_[g] = {std::cos(angle), std::sin(angle)};
}

}  // namespace softgrain::rigid_dem
