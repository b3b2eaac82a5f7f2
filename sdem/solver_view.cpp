// What other parts of the program see of the grains.
#include "sdem/solver.hpp"

namespace softgrain::sdem {

GrainView SoftDiscSolver::view(Need need) {
    GrainView v;
    v.time = time_;
    v.box = box_;
    v.centroid = grains_.position;
    v.velocity = grains_.velocity;
    v.mass = grains_.mass;
    v.reference_area = grains_.reference_area;
    v.wall_force = wall_force_;
    v.energy = energy();
    if (wants(need, Need::area) || wants(need, Need::stress)) {
        fill_areas();
        v.area = view_.area;
        v.covered_area = view_.covered_area;
    }
    if (wants(need, Need::contacts)) {
        fill_contacts();
        v.contacts = view_.contacts;
    }
    if (wants(need, Need::stress)) {
        fill_stress();
        v.stress = view_.stress;
    }
    if (wants(need, Need::outlines)) {
        fill_outlines();
        v.outline_offset = view_.outline_offset;
        v.outline_point = view_.outline_point;
    }
    if (wants(need, Need::fields)) {
        fill_fields();
        v.fields = {{"F", "1", 4, view_.F},
                    {"radius", "m", 1, grains_.radius},
                    {"principal_strain_1", "1", 1, view_.strain_1},
                    {"principal_strain_2", "1", 1, view_.strain_2},
                    {"cap_fraction", "1", 1, view_.cap_fraction},
                    {"covered_outline", "1", 1, view_.covered_outline}};
    }
    return v;
}

std::vector<Cut> SoftDiscSolver::cuts_of(std::size_t g) const {
    std::vector<Cut> cuts;
    for (std::size_t w = 0; w < 4; ++w)
        if ((wall_mask_[g] >> w & 1U) != 0)
            cuts.push_back(
                cut_of(shape_[g], -wall_normal(static_cast<int>(w)), wall_contact_[4 * g + w].point));
    for (const PairsOfGrain::Entry& entry : pairs_of_.of(g)) {
        const PairContact& c = pair_contact_[static_cast<std::size_t>(entry.pair)];
        if (!c.touching()) continue;
        const Vec2 outward = entry.second ? Vec2{-c.normal} : c.normal;
        cuts.push_back(cut_of(shape_[g], outward, c.point));
    }
    return cuts;
}

/// Chords part two grains, so the areas left add up to the area covered, overlaps counted once.
void SoftDiscSolver::fill_areas() {
    view_.area.resize(size());
    view_.covered_area = 0.0;
    for (std::size_t g = 0; g < size(); ++g) {
        view_.area[g] = clipped_area(shape_[g], cuts_of(g));
        view_.covered_area += view_.area[g];
    }
}

void SoftDiscSolver::fill_contacts() {
    view_.contacts.clear();
    std::size_t k = 0;
    const std::span<const Pair> pairs = neighbors_.pairs();
    for (std::size_t g = 0; g < size(); ++g) {
        const int i = static_cast<int>(g);
        for (int wall = 3; wall >= 0; --wall) {
            const auto w = static_cast<std::size_t>(wall);
            if ((wall_mask_[g] >> w & 1U) == 0) continue;
            const WallContact& c = wall_contact_[4 * g + w];
            view_.contacts.push_back(
                {i, -1 - wall, c.point, -wall_normal(wall), c.force.total * wall_normal(wall), c.length});
        }
        for (; k < pairs.size() && pairs[k].i == i; ++k) {
            const PairContact& c = pair_contact_[k];
            if (!c.touching()) continue;
            view_.contacts.push_back({i, pairs[k].j, c.point, c.normal, -c.force.total * c.normal, c.length});
        }
    }
}

/// Love-Weber: -(1/area) sum f (x) r over the grain's contacts, its symmetric part; compression positive.
void SoftDiscSolver::fill_stress() {
    view_.stress.assign(size(), Mat2::Zero());
    const auto add = [&](std::size_t g, const Vec2& point, const Vec2& force) {
        const Vec2 r = point - grains_.position[g];
        const Mat2 dyad = force * r.transpose();
        view_.stress[g] -= (0.5 / view_.area[g]) * (dyad + dyad.transpose());
    };
    for (std::size_t g = 0; g < size(); ++g) {
        for (std::size_t w = 0; w < 4; ++w) {
            if ((wall_mask_[g] >> w & 1U) == 0) continue;
            const WallContact& c = wall_contact_[4 * g + w];
            add(g, c.point, c.force.total * wall_normal(static_cast<int>(w)));
        }
        for (const PairsOfGrain::Entry& entry : pairs_of_.of(g)) {
            const PairContact& c = pair_contact_[static_cast<std::size_t>(entry.pair)];
            if (c.touching()) add(g, c.point, (entry.second ? c.force.total : -c.force.total) * c.normal);
        }
    }
}

void SoftDiscSolver::fill_outlines() {
    view_.outline_offset.assign(1, 0);
    view_.outline_point.clear();
    for (std::size_t g = 0; g < size(); ++g) {
        append_clipped_outline(shape_[g], cuts_of(g), options_.outline_points, view_.outline_point);
        view_.outline_offset.push_back(static_cast<int>(view_.outline_point.size()));
    }
}

void SoftDiscSolver::fill_fields() {
    const std::size_t n = size();
    view_.F.resize(4 * n);
    view_.strain_1.resize(n);
    view_.strain_2.resize(n);
    view_.cap_fraction.resize(n);
    view_.covered_outline.resize(n);
    for (std::size_t g = 0; g < n; ++g) {
        const Mat2& F = grains_.F[g];
        for (int k = 0; k < 4; ++k) view_.F[4 * g + static_cast<std::size_t>(k)] = F(k / 2, k % 2);
        const double middle = 0.5 * Polar(F).trace - 1.0, d = half_stretch_difference(F);
        view_.strain_1[g] = middle + d;
        view_.strain_2[g] = middle - d;
        view_.cap_fraction[g] = forces_[g].caps / grains_.reference_area[g];
        view_.covered_outline[g] = forces_[g].covered;
    }
}

}  // namespace softgrain::sdem
