#pragma once
// In which order the unknowns of grains and contacts are eliminated.
#include <span>
#include <vector>

namespace softgrain::mpm {

/// Nodes that always are eliminated together.
struct EliminationStep {
    std::vector<int> pivots;    ///< nodes eliminated here, ascending
    std::vector<int> rest;      ///< nodes that the pivots are coupled with, eliminated later; ascending
    std::vector<int> elements;  ///< that are summed here: first those given, then results of steps (number of
                                ///< given elements + step)
};

/// Orders the nodes of elements (sets of nodes coupled with each other) by least degree, nodes of the same
/// elements at once (Duff and Reid 1983, on the quotient graph of elements). Depends on nothing but its
/// arguments. A node in no element is not eliminated.
std::vector<EliminationStep> eliminate(std::span<const std::vector<int>> elements, std::size_t nodes);

}  // namespace softgrain::mpm
