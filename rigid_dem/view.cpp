// What rigid DEM tells about its discs. Areas assume that no three discs overlap, true within the overlap
// limit.
#include <cmath>
#include <numbers>

#include "rigid_dem/solver.hpp"

namespace softgrain::rigid_dem {
namespace {

constexpr int outline_nodes = 64;

/// Area of a disc beyond a chord at distance h from its centre [m^2].
double cap_area(double radius, double h) {
    const double c = std::clamp(h / radius, -1.0, 1.0);
    return radius * radius * (std::acos(c) - c * std::sqrt(1.0 - c * c));
}

}  // namespace

GrainView RigidDem::view(Need need) {
    GrainView view;
    view.time = time_;
    view.box = box_;
    view.centroid = x_;
    view.velocity = v_;
    view.mass = mass_;
    view.reference_area = reference_area_;
    view.wall_force = wall_force_;
    view.energy = energy_;
    if (wants(need, Need::area)) {
        measure_area();
        view.area = area_;
        view.covered_area = covered_area_;
    }
    if (wants(need, Need::contacts)) {
        list_contacts();
        view.contacts = contacts_;
    }
    if (wants(need, Need::stress)) {
        measure_stress();
        view.stress = stress_;
    }
    if (wants(need, Need::outlines)) {
        draw_outlines();
        view.outline_offset = outline_offset_;
        view.outline_point = outline_point_;
    }
    if (wants(need, Need::fields)) {
        view.fields.push_back({"radius", "m", 1, radius_});
        view.fields.push_back({"spin", "1/s", 1, spin_});
    }
    return view;
}

void RigidDem::measure_area() {
    area_ = reference_area_;
    const auto pairs = neighbors_.pairs();
    for (std::size_t k = 0; k < pairs.size(); ++k) {
        if (overlap_[k] <= 0.0) continue;
        const auto i = static_cast<std::size_t>(pairs[k].i);
        const auto j = static_cast<std::size_t>(pairs[k].j);
        const double d = radius_[i] + radius_[j] - overlap_[k];
        const double h = 0.5 * (d + (radius_[i] * radius_[i] - radius_[j] * radius_[j]) / d);
        area_[i] -= cap_area(radius_[i], h);
        area_[j] -= cap_area(radius_[j], d - h);
    }
    for (std::size_t c = 0; c < wall_overlap_.size(); ++c)
        if (wall_overlap_[c] > 0.0)
            area_[c / 4] -= cap_area(radius_[c / 4], radius_[c / 4] - wall_overlap_[c]);
    covered_area_ = 0.0;
    for (double a : area_) covered_area_ += a;
}

void RigidDem::list_contacts() {
    contacts_.clear();
    const auto pairs = neighbors_.pairs();
    std::size_t k = 0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
        for (int w = 3; w >= 0; --w) {
            const std::size_t c = 4 * i + static_cast<std::size_t>(w);
            if (wall_overlap_[c] <= 0.0) continue;
            const Vec2 inward = wall_normal(w);
            contacts_.push_back({static_cast<int>(i), -1 - w,
                                 x_[i] - (radius_[i] - wall_overlap_[c]) * inward, -inward,
                                 wall_normal_force_[c] * inward, 0.0});
        }
        for (; k < pairs.size() && pairs[k].i == static_cast<int>(i); ++k) {
            if (overlap_[k] <= 0.0) continue;
            const Vec2 n = branch(k).normalized();
            contacts_.push_back({pairs[k].i, pairs[k].j, x_[i] + (radius_[i] - 0.5 * overlap_[k]) * n, n,
                                 pair_force_[k], 0.0});
        }
    }
}

void RigidDem::measure_stress() {
    list_contacts();
    stress_.assign(x_.size(), Mat2::Zero());
    for (const GrainContact& c : contacts_) {  // Love-Weber over the disc, compression positive
        const auto i = static_cast<std::size_t>(c.i);
        stress_[i] -= c.force * (c.point - x_[i]).transpose() / reference_area_[i];
        if (c.with_wall()) continue;
        const auto j = static_cast<std::size_t>(c.j);
        const Vec2 from_j = c.point - x_[j];
        stress_[j] +=
            c.force * (box_.periodic ? box_.nearest(from_j) : from_j).transpose() / reference_area_[j];
    }
}

void RigidDem::draw_outlines() {
    outline_offset_.clear();
    outline_point_.clear();
    outline_offset_.push_back(0);
    for (std::size_t i = 0; i < x_.size(); ++i) {
        for (int p = 0; p < outline_nodes; ++p) {
            const double angle = 2.0 * std::numbers::pi * p / outline_nodes;
            outline_point_.push_back(x_[i] + radius_[i] * Vec2{std::cos(angle), std::sin(angle)});
        }
        outline_offset_.push_back(static_cast<int>(outline_point_.size()));
    }
}

}  // namespace softgrain::rigid_dem
