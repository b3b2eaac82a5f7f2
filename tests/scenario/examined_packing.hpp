#pragma once
// A packing examined with all pairs one by one.
#include <algorithm>
#include <cmath>
#include <vector>

#include "common/packing/packing.hpp"

namespace softgrain::test {

/// Smallest gap of all pairs and walls [m], of all nine nearest copies in a periodic cell; negative for an
/// overlap.
inline double smallest_gap(const Packing& p) {
    double smallest = INFINITY;
    const int copies = p.box.periodic ? 1 : 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (int wall = 0; wall < 4 && !p.box.periodic; ++wall)
            smallest = std::min(smallest, p.box.distance(wall, p.center[i]) - p.radius[i]);
        for (std::size_t j = i; j < p.size(); ++j)
            for (int ix = -copies; ix <= copies; ++ix)
                for (int iy = -copies; iy <= copies; ++iy) {
                    if (i == j && ix == 0 && iy == 0) continue;
                    const Vec2 branch = p.center[j] + p.box.image(ix, iy) - p.center[i];
                    smallest = std::min(smallest, branch.norm() - p.radius[i] - p.radius[j]);
                }
    }
    return smallest;
}

/// Pairs and walls with a gap below `reach`, of a box with walls.
inline int count_touching(const Packing& p, double reach) {
    int count = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (int wall = 0; wall < 4; ++wall)
            count += p.box.distance(wall, p.center[i]) - p.radius[i] < reach ? 1 : 0;
        for (std::size_t j = i + 1; j < p.size(); ++j)
            count += (p.center[i] - p.center[j]).norm() - p.radius[i] - p.radius[j] < reach ? 1 : 0;
    }
    return count;
}

/// All numbers, to be compared bit by bit.
inline std::vector<double> bits(const Packing& p) {
    std::vector<double> all = p.radius;
    for (const Vec2& c : p.center) all.insert(all.end(), {c.x(), c.y()});
    all.insert(all.end(), p.box.position.begin(), p.box.position.end());
    return all;
}

}  // namespace softgrain::test
