#pragma once
// Dense discs without overlap by geometry alone: nothing moves once it is placed.
#include <vector>

#include "common/packing/packing.hpp"
#include "common/packing/packing_request.hpp"

namespace softgrain {

/// An advancing front (Feng, Han & Owen 2003, Int. J. Numer. Meth. Engng 56, 699; the front as the closed
/// chain of Wang et al. 2006, CHI '06, 517): each disc, in the order given, is put against the two discs of
/// the front that lie innermost, measured by the rectangle that is to be filled. The box is the smallest of
/// the aspect ratio asked for around them: the packing fraction is what comes of it. Not for a periodic cell.
/// Equal discs make a hexagonal lattice.
Packing geometric(const std::vector<double>& radii, const PackingRequest& request);

}  // namespace softgrain
