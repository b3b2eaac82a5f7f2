#pragma once
// Attraction of the discs of one grain on each other, eight neighbours at a time. Free of Eigen.
#include <cstddef>

#include "bpm/attraction_law.hpp"

namespace softgrain::bpm {

/// Neighbours are read in runs of so many; sums are made of so many parts, whatever the processor.
inline constexpr int run_length = 8;
/// Coordinate of an empty slot, beyond the reach of every disc.
inline constexpr double far_away = 1e15;

/// Discs of one grain sorted into stripes, and for each of them the runs of slots that hold its neighbours.
struct StripedDiscs {
    int discs = 0;
    std::size_t slots = 0;                    ///< a multiple of run_length
    const double *x = nullptr, *y = nullptr;  ///< [slots]
    const double* radius = nullptr;           ///< [slots]
    const int* disc = nullptr;                ///< [discs] in the order of the slots
    const int* slot = nullptr;                ///< [discs] of the same
    const int* start = nullptr;               ///< [discs + 1] first run of each
    const int* run = nullptr;                 ///< first slot of a run
};

/// Force on each disc [N]: force[2 d] and force[2 d + 1] of disc d.
void attract(const AttractionLaw& law, const StripedDiscs& discs, double* force);

/// Half of the potentials of each disc with all others [J per unit thickness]: energy[d] of disc d.
void find_potentials(const AttractionLaw& law, const StripedDiscs& discs, double* energy);

/// Square of the largest distance between a disc and where it was, apart from what all have in common.
double largest_square_move(const StripedDiscs& discs, const double* x_before, const double* y_before);

}  // namespace softgrain::bpm
