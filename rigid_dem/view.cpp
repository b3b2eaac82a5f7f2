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
    sort_by_grain();
    GrainView view;
    view.time = time_;
    view.box = box_;
    view.centroid = x_;
    view.velocity = v_;
    view.mass = clumps_ ? clumps_->mass() : std::span<const double>(mass_);
    view.gravity = gravity_;
    view.driven = driven_.size();
    view.reference_area = reference_area_;
    view.wall_force = wall_force_;
    view.energy = energy();
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
        view.fields.push_back(
            {"radius", "m", 1, clumps_ ? clumps_->radius() : std::span<const double>(radius_)});
        view.fields.push_back({"spin", "1/s", 1, spin_});
        if (clumps_) view.fields.push_back({"angle", "rad", 1, clumps_->angles()});
    }
    return view;
}

std::span<const double> RigidDem::spin() {
    sort_by_grain();
    return spin_;
}

std::vector<Disc> RigidDem::discs() const {
    std::vector<Disc> all(radius_.size());
    each_grain([&](std::size_t grain, std::size_t r) {
        all[grain] = {Vec2{record_[r].x, record_[r].y}, record_[r].radius};
    });
    return all;
}

/// From spatial order to the grains' own.
void RigidDem::sort_by_grain() {
    const std::size_t n = reference_area_.size();
    x_.resize(n);
    v_.resize(n);
    spin_.resize(n);
    each_mover([&](std::size_t grain, const GrainRecord& g, const ForceSum&) {
        x_[grain] = {g.x, g.y};
        v_[grain] = {g.vx, g.vy};
        spin_[grain] = g.spin;
    });
}

/// Where a disc is, not in any other image.
Vec2 RigidDem::home_of(std::size_t disc) const {
    if (!clumps_) return x_[disc];
    const GrainRecord& home = record_[clumps_->record_of(disc)];
    return {home.x, home.y};
}

double RigidDem::overlap(const Block& block, std::size_t pair) const {
    const GrainRecord &a = record(block, block.pairs[pair].i), &b = record(block, block.pairs[pair].j);
    const double dx = b.x - a.x, dy = b.y - a.y;
    return a.radius + b.radius - std::sqrt(dx * dx + dy * dy);
}

ContactStiffness RigidDem::stiffness_of(const Block& block, std::size_t pair) const {
    const std::size_t at = uniform_ ? 0 : pair;
    return {block.k[at], block.shear_ratio[at]};
}

ContactMemory RigidDem::memory_of(const Block& block, std::size_t pair) const {
    const auto at = [&](const std::vector<double>& memory) { return memory.empty() ? 0.0 : memory[pair]; };
    return {at(block.shear), at(block.dashpot), at(block.grip), at(block.moment), at(block.bond)};
}

void RigidDem::measure_area() {
    area_ = reference_area_;
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        each_pair(blocks_[b], [&](std::size_t i, std::size_t j, std::size_t pair) {
            const double into = overlap(blocks_[b], pair);
            if (into <= 0.0) return;
            const double d = radius_[i] + radius_[j] - into;
            const double h = 0.5 * (d + (radius_[i] * radius_[i] - radius_[j] * radius_[j]) / d);
            area_[owner(i)] -= cap_area(radius_[i], h);
            area_[owner(j)] -= cap_area(radius_[j], d - h);
        });
        for (const WallContact& contact : wall_contacts_[b]) {
            const GrainRecord& g = record_[contact.record];
            const double into = wall_overlap(g, contact.wall, box_);
            if (into > 0.0)
                area_[owner(grain_of(blocks_[b], contact))] -= cap_area(g.radius, g.radius - into);
        }
    }
    covered_area_ = 0.0;
    for (std::size_t g = 0; g < free_grains(); ++g) covered_area_ += area_[g];
}

void RigidDem::list_contacts() {
    contacts_.clear();
    const WallMotion here{box_, walls_.velocity, walls_.tilt_rate};
    for (std::size_t b = 0; b < blocks_.size(); ++b) {
        const Block& block = blocks_[b];
        each_pair(block, [&](std::size_t i, std::size_t j, std::size_t pair) {
            const double into = overlap(block, pair);
            const ContactMemory memory = memory_of(block, pair);
            if (into <= 0.0 && memory.bond == 0.0) return;
            const GrainRecord &from = record(block, block.pairs[pair].i),
                              &to = record(block, block.pairs[pair].j);
            const double turn = i < j ? 1.0 : -1.0;
            const Vec2 n = turn * Vec2{to.x - from.x, to.y - from.y}.normalized();
            const ContactForce answer = pair_force(block, pair);
            const Vec2 force = answer.shear * perpendicular(n) - answer.normal * n;
            const std::size_t first = std::min(i, j);
            const Vec2 at = home_of(first) + (radius_[first] - 0.5 * into) * n;
            contacts_.push_back(
                {static_cast<int>(first), static_cast<int>(std::max(i, j)), at, n, force, 0.0});
        });
        for (WallContact contact : wall_contacts_[b]) {  // a copy: its memory is not to change
            const GrainRecord& g = record_[contact.record];
            const double into = wall_overlap(g, contact.wall, box_);
            if (into <= 0.0) continue;
            const Vec2 n = -wall_normal(contact.wall);
            const ContactForce answer = softgrain::rigid_dem::wall_force(contact, g, here, law_, 0.0);
            contacts_.push_back({static_cast<int>(grain_of(block, contact)), -1 - contact.wall,
                                 Vec2{g.x, g.y} + (g.radius - into) * n, n,
                                 answer.shear * perpendicular(n) - answer.normal * n, 0.0});
        }
    }
    std::sort(contacts_.begin(), contacts_.end(), [](const GrainContact& a, const GrainContact& b) {
        return std::pair(a.i, a.j) < std::pair(b.i, b.j);
    });
    if (clumps_) name_clumps();
}

/// Contacts of discs become those of their clumps. Discs are numbered by clump, so that i stays the first.
void RigidDem::name_clumps() {
    for (GrainContact& c : contacts_) {
        c.i = static_cast<int>(owner(static_cast<std::size_t>(c.i)));
        if (!c.with_wall()) c.j = static_cast<int>(owner(static_cast<std::size_t>(c.j)));
    }
    std::stable_sort(contacts_.begin(), contacts_.end(), [](const GrainContact& a, const GrainContact& b) {
        return std::pair(a.i, a.j) < std::pair(b.i, b.j);
    });
}

/// As after the last step.
ContactForce RigidDem::pair_force(const Block& block, std::size_t pair) const {
    const GrainRecord &a = record(block, block.pairs[pair].i), &b = record(block, block.pairs[pair].j);
    const double into = overlap(block, pair);
    const Vec2 n = Vec2{b.x - a.x, b.y - a.y}.normalized(), against{b.vx - a.vx, b.vy - a.vy};
    const ContactStiffness stiffness = stiffness_of(block, pair);
    ContactMemory memory = memory_of(block, pair);
    const ContactInput in{.overlap = into,
                          .closing = -against.dot(n),
                          .slip = 0.0,
                          .spin_difference = 0.0,
                          .k = stiffness.k,
                          .shear_ratio = stiffness.shear_ratio,
                          .shear_compliance = 1.0 / (stiffness.shear_ratio * stiffness.k),
                          .inverse_mass = a.inverse_mass + b.inverse_mass,
                          .rolling_radius = in_series(a.radius, b.radius),
                          .adhesive_length = 2.0 * std::min(a.radius, b.radius)};
    const LawConstants& law = law_.between_grains;
    return law_.hertz ? contact_force<Hertz, every_part & ~has_adhesion>(in, memory, law, 0.0)
                      : contact_force<Linear, every_part>(in, memory, law, 0.0);
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
        if (clumps_) {
            const std::vector<Vec2> outline = clumps_->outline(i);
            outline_point_.insert(outline_point_.end(), outline.begin(), outline.end());
        }
        for (int p = 0; !clumps_ && p < outline_nodes; ++p) {
            const double angle = 2.0 * std::numbers::pi * p / outline_nodes;
            outline_point_.push_back(x_[i] + radius_[i] * Vec2{std::cos(angle), std::sin(angle)});
        }
        outline_offset_.push_back(static_cast<int>(outline_point_.size()));
    }
}

}  // namespace softgrain::rigid_dem
