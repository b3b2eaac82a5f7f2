#pragma once
// How grains press on their contacts under the lens potential: each grain's answer depends on all that
// touches it, a contact's force on both grains' answers.
#include <vector>

#include "sdem/contact_list.hpp"
#include "sdem/pressure_block.hpp"

namespace softgrain::sdem {

/// What both grains of a pair do to each other, per chord length [N/m].
struct Push {
    double by_i, by_j;
};

struct Pressures {
    std::vector<double> stress;      ///< [n] P: part of a grain's stress along the cofactor of F [N/m]
    std::vector<Inflated> inflated;  ///< [n]
    std::vector<Push> push;          ///< [pairs]
};

/// Pressures of the grains [begin, end), at most grains_per_block, and elastic forces at walls; the first
/// grain whose area ratio Je is not above `smallest`, or n. Pairs are left to find_forces.
std::size_t find_pressures(const Grains& grains, GrainLaw law, double smallest, ContactList& list,
                           Pressures& pressures, std::size_t begin, std::size_t end);

/// Elastic forces of the pairs [begin, end).
void find_forces(const Pressures& pressures, ContactList& list, std::size_t begin, std::size_t end);

}  // namespace softgrain::sdem
