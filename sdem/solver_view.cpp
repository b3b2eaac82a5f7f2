// What other parts of the program see of the grains, in the order of the packing.
#include <algorithm>

#include "sdem/solver.hpp"

namespace softgrain::sdem {

GrainView SoftDiscSolver::view(Need need) {
    fill_state();
    GrainView v;
    v.time = time_;
    v.box = motion_.box;
    v.centroid = view_.center;
    v.velocity = view_.velocity;
    v.mass = view_.mass;
    v.gravity = options_.motion.gravity;
    v.reference_area = view_.reference_area;
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
                    {"radius", "m", 1, view_.radius},
                    {"principal_strain_1", "1", 1, view_.strain_1},
                    {"principal_strain_2", "1", 1, view_.strain_2},
                    {"cap_fraction", "1", 1, view_.cap_fraction},
                    {"clipped_area", "m^2", 1, view_.clipped_area}};
        if (!has_potential()) v.fields.push_back({"covered_outline", "1", 1, view_.covered_outline});
        if (options_.motion.plastic) v.fields.push_back({"plastic_strain", "1", 1, view_.plastic_strain});
        if (!grains_.grain_class.empty()) v.fields.push_back({"grain_class", "1", 1, view_.grain_class});
    }
    return v;
}

void SoftDiscSolver::fill_state() {
    const std::size_t n = size();
    view_.place.resize(n);
    view_.center.resize(n);
    view_.velocity.resize(n);
    view_.mass.resize(n);
    view_.reference_area.resize(n);
    for (std::size_t g = 0; g < n; ++g) {
        const auto p = static_cast<std::size_t>(grains_.original[g]);
        const Grain& grain = grains_.grain[g];
        view_.place[p] = g;
        view_.center[p] = grains_.center[g];
        view_.velocity[p] = Vec2{grain.vx, grain.vy};
        view_.mass[p] = grain.mass;
        view_.reference_area[p] = grain.reference_area();
    }
}

std::vector<Cut> SoftDiscSolver::cuts_of(std::size_t g) const {
    std::vector<Cut> cuts;
    const Ellipse shape = ellipse_of(grains_.grain[g]);
    contact_view().each_side_of(g, [&](const Side& side) {
        const Vec2 outward = -side.sign() * Vec2{side.contact.chord_x, side.contact.chord_y}.normalized();
        cuts.push_back(cut_of(shape, outward, grains_.center[g] + Vec2{side.arm_x, side.arm_y}));
    });
    return cuts;
}

/// The lens potential knows what area a grain's material takes, A0 Je: what its caps displace bulges beside
/// them. Else what the chords leave of the ellipse; chords part two grains, so that overlaps count once.
void SoftDiscSolver::fill_areas() {
    view_.area.resize(size());
    view_.covered_area = 0.0;
    for (std::size_t p = 0; p < size(); ++p) {
        const std::size_t g = view_.place[p];
        view_.area[p] = has_potential() ? grains_.grain[g].reference_area() * area_ratio(g, overlaps(g))
                                        : clipped_area(ellipse_of(grains_.grain[g]), cuts_of(g));
        view_.covered_area += view_.area[p];
    }
}

void SoftDiscSolver::fill_contacts() {
    view_.contacts.clear();
    const ForceSource source = forces();
    for (std::size_t g = 0; g < size(); ++g) {
        source.contacts.each_side_of(g, [&](const Side& side) {
            const int i = packing_index(g);
            const int j = side.wall() ? side.other : packing_index(static_cast<std::size_t>(side.other));
            if (!side.wall() && i > j) return;  // told by the other grain
            const Contact& c = side.contact;
            const double q = c.q;
            const Vec2 chord = -side.sign() * Vec2{c.chord_x, c.chord_y};  // out of this grain
            GrainContact contact;
            contact.i = i;
            contact.j = j;
            contact.point = grains_.center[g] + Vec2{side.arm_x, side.arm_y};
            contact.length = chord.norm();
            contact.normal = chord / contact.length;
            contact.force = -(q + damping_without_pull(q, c.q_damping)) * chord -
                            source.tangential(side) * perpendicular(chord);
            view_.contacts.push_back(contact);
        });
    }
    std::sort(view_.contacts.begin(), view_.contacts.end(), [](const GrainContact& a, const GrainContact& b) {
        return a.i != b.i ? a.i < b.i : a.j < b.j;
    });
}

/// Love-Weber: -(1/area) sum f (x) r over the grain's contacts, its symmetric part; compression positive.
void SoftDiscSolver::fill_stress() {
    view_.stress.resize(size());
    const ForceSource source = forces();
    for (std::size_t p = 0; p < size(); ++p) {
        const Mat2 moment = matrix_of(sum_contacts(source, view_.place[p]).moment);
        view_.stress[p] = (-0.5 / view_.area[p]) * (moment + moment.transpose());
    }
}

void SoftDiscSolver::fill_outlines() {
    view_.outline_offset.assign(1, 0);
    view_.outline_point.clear();
    for (std::size_t p = 0; p < size(); ++p) {
        const std::size_t g = view_.place[p];
        append_clipped_outline(ellipse_of(grains_.grain[g]), cuts_of(g), options_.outline_points,
                               view_.outline_point);
        view_.outline_offset.push_back(static_cast<int>(view_.outline_point.size()));
    }
}

void SoftDiscSolver::fill_fields() {
    const std::size_t n = size();
    view_.F.resize(4 * n);
    for (auto* values :
         {&view_.clipped_area, &view_.radius, &view_.strain_1, &view_.strain_2, &view_.cap_fraction,
          &view_.covered_outline, &view_.plastic_strain, &view_.grain_class})
        values->resize(n);
    for (std::size_t p = 0; p < n; ++p) {
        const std::size_t g = view_.place[p];
        const Grain& grain = grains_.grain[g];
        const Mat2 F = matrix_of(grain.F);
        for (int k = 0; k < 4; ++k) view_.F[4 * p + static_cast<std::size_t>(k)] = F(k / 2, k % 2);
        const double middle = 0.5 * Polar(grain.F).trace - 1.0, d = half_stretch_difference(grain.F);
        const GrainSums sums = sum_contacts(forces(), g);
        view_.clipped_area[p] = clipped_area(ellipse_of(grain), cuts_of(g));
        view_.radius[p] = grain.radius;
        view_.strain_1[p] = middle + d;
        view_.strain_2[p] = middle - d;
        view_.cap_fraction[p] = sums.caps / grain.reference_area();
        if (contacts_.keeps_openings) view_.covered_outline[p] = covered_outline(contacts_, g);
        // Logarithmic: principal values of Fp are l and 1/l, those of G their inverse squares.
        view_.plastic_strain[p] =
            options_.motion.plastic
                ? 0.5 * std::acosh(std::max(1.0, 0.5 * (memory_.plastic_xx[g] + memory_.plastic_yy[g])))
                : 0.0;
        view_.grain_class[p] = grains_.grain_class.empty() ? 0.0 : grains_.grain_class[g];
    }
}

}  // namespace softgrain::sdem
