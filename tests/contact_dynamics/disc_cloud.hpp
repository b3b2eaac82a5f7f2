#pragma once
// Discs with random velocities, for the tests of contact dynamics.
#include <random>
#include <vector>

#include "common/contact_dynamics/discs.hpp"

namespace softgrain {

struct DiscCloud {
    std::vector<Vec2> x, v;
    std::vector<double> radius, mass, rim_speed;
    std::vector<int> group;

    Discs discs() { return {x, radius, mass, group, v, rim_speed}; }
    std::size_t size() const { return x.size(); }
};

/// columns x rows discs on a jittered triangular lattice, gaps of about -0.02 to 0.15, groups of neighbours.
inline DiscCloud disc_cloud(unsigned seed, int columns, int rows, int groups_across) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    DiscCloud cloud;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            cloud.x.emplace_back(column + 0.5 * (row % 2) + 0.06 * unit(random),
                                 0.87 * row + 0.06 * unit(random));
            cloud.radius.push_back(0.46 + 0.04 * unit(random));
            cloud.mass.push_back(0.5 + unit(random));
            cloud.v.emplace_back(unit(random) - 0.5, unit(random) - 0.5);
            cloud.rim_speed.push_back(0.0);
            cloud.group.push_back(column * groups_across / columns);
        }
    return cloud;
}

}  // namespace softgrain
