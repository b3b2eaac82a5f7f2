#include "common/observables/stress.hpp"

namespace softgrain {

Vec2 wall_stress(const std::array<Vec2, 4>& wall_force, const Box& box) {
    return {0.5 * (wall_force[1].x() - wall_force[0].x()) / box.height(),
            0.5 * (wall_force[3].y() - wall_force[2].y()) / box.width()};
}

Mat2 love_weber_stress(const GrainView& view) {
    Mat2 sum = Mat2::Zero();
    for (const GrainContact& c : view.contacts) {
        const Vec2& from = c.with_wall() ? c.point : view.centroid[static_cast<std::size_t>(c.j)];
        sum += c.force * (view.centroid[static_cast<std::size_t>(c.i)] - from).transpose();
    }
    return sum / view.box.area();
}

double unbalanced_force(const GrainView& view) {
    if (view.contacts.empty()) return 0.0;
    std::vector<Vec2> net(view.size(), Vec2::Zero());
    double contact_force = 0.0;
    for (const GrainContact& c : view.contacts) {
        net[static_cast<std::size_t>(c.i)] += c.force;
        if (!c.with_wall()) net[static_cast<std::size_t>(c.j)] -= c.force;
        contact_force += c.force.norm();
    }
    double unbalanced = 0.0;
    for (const Vec2& f : net) unbalanced += f.norm();
    contact_force /= static_cast<double>(view.contacts.size());
    return contact_force > 0.0 ? unbalanced / static_cast<double>(view.size()) / contact_force : 0.0;
}

}  // namespace softgrain
