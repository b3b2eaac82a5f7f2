#pragma once
// How grains press on their contacts under the lens potential: each grain's answer depends on all that
// touches it, a contact's force on the answers of both grains.
#include <span>
#include <vector>

#include "sdem/contact_list.hpp"
#include "sdem/pressure_block.hpp"

namespace softgrain::sdem {

/// What the grains say about each of their contacts; nothing of use where nothing touches.
struct SideValues {
    struct OfPair {
        double i, j;
    };
    std::vector<OfPair> pair;
    std::vector<double> wall;

    void resize(const ContactList& list) {
        pair.resize(list.pairs().size());
        wall.resize(list.wall_pairs().size());
    }
};

struct Pressures {
    std::vector<double> stress;      ///< [n] P: part of a grain's stress along the cofactor of F [N/m]
    std::vector<Inflated> inflated;  ///< [n]
    /// Pushes dU/d(beta S) of one side while forces are found [N/m], resistances while the time step is.
    SideValues side;
};

/// Pressures of the grains [begin, end), at most grains_per_block; the first grain whose area ratio Je is not
/// above `smallest`, or n.
std::size_t find_pressures(const Grains& grains, GrainLaw law, double smallest, const ContactList& list,
                           Pressures& pressures, std::size_t begin, std::size_t end);

/// Resistances of the grains [begin, end), at most grains_per_block, against more overlap at each contact:
/// dpush/d(beta S), an estimate up to 20 % low [N/m^3].
void find_resistances(const Grains& grains, const ContactList& list, std::span<const Inflated> inflated,
                      SideValues& resistance, std::size_t begin, std::size_t end);
/// The same at one contact with this overlap beta S > 0 [m^2].
double resistance_of(const Grains& grains, std::span<const Inflated> inflated, std::size_t g, double overlap);

/// Elastic forces of the pairs or of the wall pairs [begin, end) from the pushes of both sides.
void find_pair_forces(const SideValues& push, ContactList& list, std::size_t begin, std::size_t end);
void find_wall_forces(const SideValues& push, ContactList& list, std::size_t begin, std::size_t end);

}  // namespace softgrain::sdem
