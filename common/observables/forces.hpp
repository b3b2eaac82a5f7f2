#pragma once
// How normal forces are distributed over the contacts, and the chains that carry the most.
#include <vector>

#include "common/observables/histogram.hpp"
#include "common/observables/observable.hpp"

namespace softgrain {

/// Normal forces / their mean, over the contacts between grains that press; bins of this width from 0 on, as
/// many as are needed. Empty without such contacts.
Histogram force_distribution(const GrainView& view, double bin);

/// Force chains after Peters et al. 2005, Phys. Rev. E 72, 041307.
struct ForceChains {
    /// [free grains] sum of -f (x) (arm to the contact) / reference area, compression positive, symmetric
    /// [N/m]
    std::vector<Mat2> stress;
    std::vector<int> chain;  ///< [free grains] number of the chain, by its first grain; -1 for grains in none
    int chains = 0;          ///< of 3 grains or more
};

/// Linked are two grains in contact whose larger principal stresses are both above the mean of it over all
/// grains, if the way between them lies within `turn` [rad] of the directions of both; a chain is what is
/// linked, branches included. The arms of two grains share the line between their centres by the radii of
/// discs of their reference areas; at a wall the arm ends at the contact point.
ForceChains force_chains(const GrainView& view, double turn);

}  // namespace softgrain
