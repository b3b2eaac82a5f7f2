#pragma once
#include "common/packing/jam.hpp"
#include "common/packing/size_laws.hpp"

namespace softgrain::testing {

/// Jammed discs of the default sizes, always the same.
inline Packing jammed(int grains, bool periodic) {
    PackingSpec spec;
    spec.count = grains;
    Random random(4);
    const auto radii = draw_radii(spec, random);
    return jam(radii, {.periodic = periodic}, random).packing;
}
inline Packing jammed_cell(int grains) {
    return jammed(grains, true);
}
inline Packing jammed_box(int grains) {
    return jammed(grains, false);
}

}  // namespace softgrain::testing
