#pragma once
// Contacts with a memory: Coulomb friction with a spring along the chord, and cohesion.
#include "sdem/grain_sums.hpp"

namespace softgrain::sdem {

struct SlidingLaw {
    double friction = 0.0, wall_friction = 0.0;  ///< Coulomb coefficients
    double stiffness = 0.5;                      ///< of the tangential spring, in E of the pair
    double cohesion = 0.0;                       ///< adhesive normal stress on a chord [N/m]
    /// Overlap over which adhesion builds up when a contact opens, in reference areas of the smaller grain.
    /// 0: the same on closing and opening.
    double adhesion_range = 0.0;

    bool slides() const { return friction > 0.0 || wall_friction > 0.0; }
    bool needs_history() const { return slides() || (cohesion > 0.0 && adhesion_range > 0.0); }
    bool acts() const { return slides() || cohesion > 0.0; }
};

/// Dissipated in a step [J].
struct SlidingWork {
    double friction = 0.0, adhesion = 0.0;

    void add(const SlidingWork& other) {
        friction += other.friction;
        adhesion += other.adhesion;
    }
};

/// Sets tangential forces and takes adhesion off the normal force of the pairs [begin, end). After the normal
/// forces and pressures are known; dt is the length of the step just made, 0 to change no memory.
SlidingWork slide_pairs(const SlidingLaw& law, const Grains& grains, ContactList& list, double dt,
                        std::size_t begin, std::size_t end);
/// The same for the wall pairs [begin, end).
SlidingWork slide_walls(const SlidingLaw& law, const Grains& grains, ContactList& list, double dt,
                        std::size_t begin, std::size_t end);

/// Energy now in springs and adhesion [J].
double stored_energy(const SlidingLaw& law, const Grains& grains, const ContactList& list);

}  // namespace softgrain::sdem
