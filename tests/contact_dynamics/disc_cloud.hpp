#pragma once
// Discs with random velocities, for the tests of contact dynamics.
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "common/box.hpp"
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

/// Discs that flow together between four walls that close in, so that a step of 0.1 brings most neighbours
/// into contact. Every disc spins.
struct SqueezedCloud {
    static constexpr double h = 0.1;
    DiscCloud cloud;
    WallMotion walls;

    SqueezedCloud(unsigned seed, int columns, int rows, int groups_across)
        : cloud(disc_cloud(seed, columns, rows, groups_across)),
          walls{{{-0.48, columns + 0.05, -0.48, 0.87 * rows - 0.3}}, {1.0, -1.1, 0.9, -0.8}} {
        for (std::size_t d = 0; d < cloud.size(); ++d)
            cloud.rim_speed[d] = 0.3 * std::sin(3.0 * static_cast<double>(d));
        const std::array<double, 4>& at = walls.box.position;
        const Vec2 middle(0.5 * (at[0] + at[1]), 0.5 * (at[2] + at[3]));
        for (std::size_t d = 0; d < cloud.size(); ++d) cloud.v[d] -= 0.1 * (cloud.x[d] - middle);
    }
    void advance() {
        for (std::size_t d = 0; d < cloud.size(); ++d) cloud.x[d] += h * cloud.v[d];
        walls.box = walls.after(h);
    }
};

}  // namespace softgrain
