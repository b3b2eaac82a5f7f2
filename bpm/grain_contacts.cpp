#include "bpm/grain_contacts.hpp"

#include <algorithm>
#include <limits>

#include "common/at.hpp"

namespace softgrain::bpm {
namespace {

/// One disc against a disc of another grain or against a wall.
struct Touch {
    int i, j;  ///< grain, and grain or -1 - wall
    Vec2 point;
    Vec2 normal_force;   ///< on j, along the normal out of i [N]
    Vec2 force;          ///< on i [N]
    double half_extent;  ///< radius of the smaller disc [m]
};

void append_disc_touches(const SolvedContacts& solved, const GrainContactInput& in,
                         std::vector<Touch>& touches) {
    const ContactRows& rows = solved.rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t i = at(rows.i[k]);
        const std::size_t j = at(rows.j[k]);
        if (in.discs.group[i] == in.discs.group[j]) continue;
        const Vec2 line = in.discs.x[j] - in.discs.x[i];
        const double gap = line.norm() - in.discs.radius[i] - in.discs.radius[j];
        if (gap >= in.touch_gap && rows.normal[k] == 0.0) continue;
        const double scale = solved.reduced_mass(k, in.discs.mass) / in.step;
        const Vec2 along = scale * rows.normal[k] * rows.direction[k];
        const Vec2 across = scale * rows.tangential_of(k) * perpendicular(rows.direction[k]);
        const Vec2 point = in.discs.x[i] + line.normalized() * (in.discs.radius[i] + 0.5 * gap);
        Touch touch{in.discs.group[i],
                    in.discs.group[j],
                    point,
                    along,
                    -along - across,
                    std::min(in.discs.radius[i], in.discs.radius[j])};
        if (touch.i > touch.j) {
            std::swap(touch.i, touch.j);
            touch.normal_force = -touch.normal_force;
            touch.force = -touch.force;
        }
        touches.push_back(touch);
    }
}

void append_wall_touches(const SolvedContacts& solved, const GrainContactInput& in,
                         std::vector<Touch>& touches) {
    const WallRows& rows = solved.wall_rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t d = at(rows.disc[k]);
        const double gap = in.box.distance(rows.wall[k], in.discs.x[d]) - in.discs.radius[d];
        if (gap >= in.touch_gap && rows.normal[k] == 0.0) continue;
        const Vec2 inward = wall_normal(rows.wall[k]);
        const Vec2 force = in.discs.mass[d] * rows.normal[k] / in.step * inward;
        touches.push_back({in.discs.group[d], -1 - rows.wall[k], in.discs.x[d] - in.discs.radius[d] * inward,
                           -force, force, in.discs.radius[d]});
    }
}

/// Sum of the touches of one pair.
GrainContact sum_of(std::span<const Touch> touches, const GrainContactInput& in) {
    Vec2 along = Vec2::Zero(), force = Vec2::Zero(), weighted = Vec2::Zero(), mean = Vec2::Zero();
    double weight = 0.0;
    for (const Touch& touch : touches) {
        const double size = touch.normal_force.norm();
        along += touch.normal_force;
        force += touch.force;
        weighted += size * touch.point;
        weight += size;
        mean += touch.point / static_cast<double>(touches.size());
    }
    GrainContact contact{touches[0].i, touches[0].j, mean, Vec2::UnitX(), force, 0.0};
    if (weight > 0.0) contact.point = weighted / weight;
    if (contact.with_wall())
        contact.normal = -wall_normal(contact.wall());
    else if (along.norm() > 0.0)
        contact.normal = along.normalized();
    else
        contact.normal = (in.centroid[at(contact.j)] - in.centroid[at(contact.i)]).normalized();

    const Vec2 tangent = perpendicular(contact.normal);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Touch& touch : touches) {
        low = std::min(low, tangent.dot(touch.point) - touch.half_extent);
        high = std::max(high, tangent.dot(touch.point) + touch.half_extent);
    }
    contact.length = high - low;
    return contact;
}

}  // namespace

GrainContacts sum_grain_contacts(const SolvedContacts& solved, const GrainContactInput& in) {
    std::vector<Touch> touches;
    append_disc_touches(solved, in, touches);
    append_wall_touches(solved, in, touches);
    std::stable_sort(touches.begin(), touches.end(),
                     [](const Touch& a, const Touch& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });

    GrainContacts result;
    result.stress.assign(in.centroid.size(), Mat2::Zero());
    for (const Touch& touch : touches) {
        const auto add = [&](int grain, const Vec2& force) {
            const std::size_t g = at(grain);
            result.stress[g] -= force * (touch.point - in.centroid[g]).transpose() / in.area[g];
        };
        add(touch.i, touch.force);
        if (touch.j >= 0) add(touch.j, -touch.force);
    }
    for (std::size_t first = 0; first < touches.size();) {
        std::size_t last = first + 1;
        while (last < touches.size() && touches[last].i == touches[first].i &&
               touches[last].j == touches[first].j)
            ++last;
        result.contacts.push_back(sum_of(std::span<const Touch>(touches).subspan(first, last - first), in));
        first = last;
    }
    return result;
}

}  // namespace softgrain::bpm
