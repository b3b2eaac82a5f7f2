#pragma once
// Forces of the pairs of one block of grains.
#include "rigid_dem/grain_record.hpp"
#include "rigid_dem/laws/constants.hpp"

namespace softgrain::rigid_dem {

/// Sums over the pairs of a block, kept by lane so that they do not depend on the vectors' length.
struct PairSums {
    using Lane = double[lanes];
    alignas(64) Lane virial_xx, virial_xy, virial_yx, virial_yy;  ///< force on i (x) branch from i to j [N m]
    alignas(64) Lane friction_loss, damping_loss, adhesion_loss;  ///< in this step [J]
    alignas(64) Lane overlap;                                     ///< largest [m]
};

/// What pairs remember, an array for each quantity that the law has; null if it has not. Padded to whole
/// batches.
struct PairMemory {
    double *shear = nullptr, *dashpot = nullptr, *grip = nullptr, *moment = nullptr, *bond = nullptr;
};

struct PairBlock {
    const GrainRecord* grain;  ///< its own, then copies of their partners outside
    ForceSum* force;           ///< of the same; added to
    const LocalPair* pair;
    int pairs;
    // As in ContactInput, of each pair, or one batch for all if they are `uniform`.
    const double *k, *shear_ratio, *shear_compliance;
    bool uniform;
    PairMemory memory;
    PairSums* sums;  ///< added to
};

/// `dt` of the step that led here [s]; 0 leaves the memory as it is.
using PairKernel = void (*)(const PairBlock& block, const LawConstants& law, double dt);

/// The kernel for a law; has_rolling and has_adhesion come with has_friction, has_adhesion not with Hertz.
PairKernel pair_kernel(bool hertz, unsigned features, bool with_virial);

}  // namespace softgrain::rigid_dem
