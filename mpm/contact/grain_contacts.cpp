#include "mpm/contact/grain_contacts.hpp"

#include <algorithm>

namespace softgrain::mpm {
namespace {

/// Length of the surface that a point stands for now, half of it if the other grain has points too [m].
double length_of(const Grains& grains, const Surfaces& surfaces, const PointContact& c) {
    const auto points = surfaces.points_of(grains, static_cast<std::size_t>(c.i));
    const std::size_t n = points.size(), k = static_cast<std::size_t>(c.point);
    const double length = 0.5 * (points[(k + 1) % n] - points[(k + n - 1) % n]).norm();
    return c.j >= 0 ? 0.5 * length : length;
}

}  // namespace

std::vector<GrainContact> sum_grain_contacts(const Grains& grains, const Surfaces& surfaces,
                                             const Contacts& contacts, std::span<const Slider> sliders) {
    std::vector<GrainContact> found;
    for (const ContactGroup& group : contacts.groups()) {
        GrainContact sum{group.i, group.j, Vec2::Zero(), Vec2::Zero(), Vec2::Zero(), 0.0};
        Vec2 rubbed = Vec2::Zero();
        double pressed = 0.0;
        for (int p = group.first; p < group.first + group.count; ++p) {
            const PointContact& c = contacts.points()[static_cast<std::size_t>(p)];
            if (!c.touches()) continue;
            const double f = c.force();
            const double sign = c.i == group.i ? 1.0 : -1.0;
            sum.force += sign * f * c.place.normal;
            if (!sliders.empty())
                rubbed -= sign * sliders[static_cast<std::size_t>(p)].force() * c.place.tangent;
            sum.point += f * surfaces.points_of(
                                 grains, static_cast<std::size_t>(c.i))[static_cast<std::size_t>(c.point)];
            sum.length += length_of(grains, surfaces, c);
            pressed += f;
        }
        if (pressed <= 0.0) continue;
        sum.point /= pressed;
        sum.normal = -sum.force.normalized();
        sum.force += rubbed;
        found.push_back(sum);
    }
    return found;
}

double overlap_area(const Surfaces& surfaces, const Contacts& contacts, const Grains& grains) {
    double sum = 0.0;
    for (const PointContact& c : contacts.points())
        if (c.touches()) sum -= c.place.gap * length_of(grains, surfaces, c);
    return sum;
}

double deepest_overlap(const Contacts& contacts) {
    double deepest = 0.0;
    for (const PointContact& c : contacts.points()) deepest = std::max(deepest, -c.place.gap);
    return deepest;
}

}  // namespace softgrain::mpm
