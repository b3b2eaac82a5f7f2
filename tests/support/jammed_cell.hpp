#pragma once
#include "common/packing/jam.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain::testing {

/// Jammed discs of the default sizes in a periodic cell, always the same.
inline Packing jammed_cell(int grains) {
    PackingSpec spec;
    spec.count = grains;
    Random random(4);
    const auto radii = draw_radii(spec, random);
    return jam(radii, {.periodic = true}, random).packing;
}

}  // namespace softgrain::testing
