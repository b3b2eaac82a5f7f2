#include "mpm/disc/dissection.hpp"

#include <algorithm>

#include "common/at.hpp"

namespace softgrain::mpm {
namespace {

/// Regions below this size are not divided: dense elimination of them is as fast.
constexpr std::size_t small_region = 24;

}  // namespace

Dissection::Dissection(const ReferenceDisc& disc, const StiffnessPattern& pattern) : coupled(disc.nodes()) {
    for (int m = 0; m < static_cast<int>(disc.nodes()); ++m)
        for (int k = pattern.start[at(m)]; k < pattern.start[at(m) + 1]; ++k) {
            const int n = pattern.column[at(k)];
            coupled[at(m)].push_back({n, k, false});
            if (n != m) coupled[at(n)].push_back({m, k, true});
        }
    for (auto& of_node : coupled)
        std::sort(of_node.begin(), of_node.end(),
                  [](const Coupling& a, const Coupling& b) { return a.node < b.node; });
    std::vector<int> all(disc.nodes());
    for (std::size_t m = 0; m < all.size(); ++m) all[m] = static_cast<int>(m);
    region[at(divide(disc, std::move(all)))].parent = -1;
}

/// Halves across the longer side, with the nodes of the first half that touch the second as separator.
/// Returns the number of the last region made.
int Dissection::divide(const ReferenceDisc& disc, std::vector<int> nodes) {
    std::vector<int> separator, children;
    if (nodes.size() > small_region) {
        Vec2 low = disc.coordinate[at(nodes[0])], high = low;
        for (const int m : nodes) {
            low = low.cwiseMin(disc.coordinate[at(m)]);
            high = high.cwiseMax(disc.coordinate[at(m)]);
        }
        const int axis = high.x() - low.x() >= high.y() - low.y() ? 0 : 1;
        const double middle = 0.5 * (low[axis] + high[axis]);
        const auto second = [&](int m) { return disc.coordinate[at(m)][axis] > middle; };
        std::vector<char> in_second(coupled.size(), 0);
        for (const int m : nodes) in_second[at(m)] = second(m);
        std::vector<int> half[2];
        for (const int m : nodes) {
            if (in_second[at(m)]) {
                half[1].push_back(m);
                continue;
            }
            const auto& near = coupled[at(m)];
            const bool touches = std::any_of(near.begin(), near.end(),
                                             [&](const Coupling& c) { return in_second[at(c.node)]; });
            (touches ? separator : half[0]).push_back(m);
        }
        for (auto& h : half)
            if (!h.empty()) children.push_back(divide(disc, std::move(h)));
    } else {
        separator = std::move(nodes);
    }
    const int own = static_cast<int>(region.size());
    region.push_back({std::move(separator), -1});
    for (const int child : children) region[at(child)].parent = own;
    return own;
}

}  // namespace softgrain::mpm
