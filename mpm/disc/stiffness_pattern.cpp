#include "mpm/disc/stiffness_pattern.hpp"

#include <algorithm>
#include <set>

namespace softgrain::mpm {

StiffnessPattern::StiffnessPattern(const ReferenceDisc& disc) {
    const auto node = [&](const Cell& c, int a) {
        return disc.cell_node[static_cast<std::size_t>(c.first_node + a)];
    };
    std::vector<std::set<int>> row(disc.nodes());
    for (const Cell& c : disc.cell)
        for (int a = 0; a < c.nodes; ++a)
            for (int b = 0; b <= a; ++b) row[static_cast<std::size_t>(node(c, a))].insert(node(c, b));
    start.push_back(0);
    for (const auto& columns : row) {
        column.insert(column.end(), columns.begin(), columns.end());
        start.push_back(static_cast<int>(column.size()));
    }
    for (const Cell& c : disc.cell) {
        cell_start.push_back(static_cast<int>(place.size()));
        for (int a = 0; a < c.nodes; ++a)
            for (int b = 0; b <= a; ++b) {
                const auto m = static_cast<std::size_t>(node(c, a));
                const auto at =
                    std::lower_bound(column.begin() + start[m], column.begin() + start[m + 1], node(c, b));
                place.push_back(static_cast<int>(at - column.begin()));
            }
    }
}

}  // namespace softgrain::mpm
