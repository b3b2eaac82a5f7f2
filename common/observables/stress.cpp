#include "common/observables/stress.hpp"

#include <algorithm>

namespace softgrain {

Vec2 wall_stress(const std::array<Vec2, 4>& wall_force, const Box& box) {
    return {0.5 * (wall_force[1].x() - wall_force[0].x()) / box.height(),
            0.5 * (wall_force[3].y() - wall_force[2].y()) / box.width()};
}

Mat2 boundary_stress(const std::array<Vec2, 4>& wall_force, const Mat2& cell_stress, const Box& box) {
    if (box.periodic) return 0.5 * (cell_stress + cell_stress.transpose());
    const Vec2 normal = wall_stress(wall_force, box);
    const double on_sides = 0.5 * (wall_force[1].y() - wall_force[0].y()) / box.height();
    const double on_ends = 0.5 * (wall_force[3].x() - wall_force[2].x()) / box.width();
    const double shear = 0.5 * (on_sides + on_ends);
    return (Mat2() << normal.x(), shear, shear, normal.y()).finished();
}

Vec2 branch(const GrainView& view, const GrainContact& contact) {
    const Vec2& from = view.centroid[static_cast<std::size_t>(contact.i)];
    if (view.at_boundary(contact)) return contact.point - from;
    const Vec2 to_other = view.centroid[static_cast<std::size_t>(contact.j)] - from;
    return view.box.periodic ? view.box.nearest(to_other) : to_other;
}

Mat2 love_weber_stress(const GrainView& view) {
    Mat2 sum = Mat2::Zero();
    for (const GrainContact& c : view.contacts) sum -= c.force * branch(view, c).transpose();
    return sum / view.box.area();
}

double unbalanced_force(const GrainView& view) {
    std::vector<Vec2> net(view.free_size(), Vec2::Zero());
    double mean_weight = 0.0, contact_force = 0.0;
    if (!view.gravity.isZero(0.0))
        for (std::size_t g = 0; g < view.free_size(); ++g) {
            net[g] = view.mass[g] * view.gravity;
            mean_weight += net[g].norm() / static_cast<double>(view.free_size());
        }
    for (const GrainContact& c : view.contacts) {
        net[static_cast<std::size_t>(c.i)] += c.force;
        if (!view.at_boundary(c)) net[static_cast<std::size_t>(c.j)] -= c.force;
        contact_force += c.force.norm();
    }
    double unbalanced = 0.0;
    for (const Vec2& f : net) unbalanced += f.norm();
    if (!view.contacts.empty()) contact_force /= static_cast<double>(view.contacts.size());
    const double scale = std::max(contact_force, mean_weight);
    return scale > 0.0 ? unbalanced / static_cast<double>(view.free_size()) / scale : 0.0;
}

}  // namespace softgrain
