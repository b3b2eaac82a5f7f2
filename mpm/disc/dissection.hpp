#pragma once
// In which order the nodes of a disc are best eliminated.
#include <vector>

#include "mpm/disc/stiffness_pattern.hpp"

namespace softgrain::mpm {

/// Which nodes a node is coupled with, itself included, and where the stiffness pattern has it.
struct Coupling {
    int node;
    int place;
    bool transposed;  ///< the pattern has (node, this), not (this, node)
};

/// Nested dissection (George 1973) of the nodes of a disc: regions that are coupled only with regions after
/// them on their way to the last one.
struct Dissection {
    Dissection(const ReferenceDisc& disc, const StiffnessPattern& pattern);

    struct Region {
        std::vector<int> nodes;  ///< ascending
        int parent;              ///< -1 of the last
    };
    std::vector<Region> region;                  ///< children before their parent
    std::vector<std::vector<Coupling>> coupled;  ///< [nodes] ascending

  private:
    int divide(const ReferenceDisc& disc, std::vector<int> nodes);
};

}  // namespace softgrain::mpm
