#include "bpm/disc_contacts.hpp"

#include <algorithm>
#include <cmath>

#include "common/at.hpp"

namespace softgrain::bpm {

DiscContacts list_disc_contacts(const SolvedContacts& solved, const GrainContactInput& in) {
    DiscContacts result;
    result.touching.assign(in.discs.x.size(), 0.0);
    result.force.assign(in.discs.x.size(), 0.0);
    const auto meet = [&](int disc, double normal_force) {
        result.touching[at(disc)] += 1.0;
        result.force[at(disc)] += std::abs(normal_force);
    };
    const ContactRows& rows = solved.rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
        const std::size_t i = at(rows.i[k]);
        const std::size_t j = at(rows.j[k]);
        const double gap = (in.discs.x[j] - in.discs.x[i]).norm() - in.discs.radius[i] - in.discs.radius[j];
        if (gap >= in.touch_gap && rows.normal[k] == 0.0) continue;
        const double scale = solved.reduced_mass(k, in.discs.mass) / in.step;
        const double force = scale * rows.normal[k];
        meet(rows.i[k], force);
        meet(rows.j[k], force);
        if (force != 0.0)
            result.contacts.push_back({rows.i[k], rows.j[k], force, -scale * rows.tangential_of(k)});
    }
    const WallRows& walls = solved.wall_rows;
    for (std::size_t k = 0; k < walls.size(); ++k) {
        const std::size_t d = at(walls.disc[k]);
        const double gap = in.box.distance(walls.wall[k], in.discs.x[d]) - in.discs.radius[d];
        if (gap >= in.touch_gap && walls.normal[k] == 0.0) continue;
        const double force = in.discs.mass[d] * walls.normal[k] / in.step;
        meet(walls.disc[k], force);
        if (force != 0.0) result.contacts.push_back({walls.disc[k], -1 - walls.wall[k], force, 0.0});
    }
    std::sort(result.contacts.begin(), result.contacts.end(),
              [](const PartContact& a, const PartContact& b) { return a.i != b.i ? a.i < b.i : a.j < b.j; });
    return result;
}

}  // namespace softgrain::bpm
