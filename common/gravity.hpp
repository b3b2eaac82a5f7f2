#pragma once
// The body force that a scenario asks for, the same on every grain.
#include "common/packing/packing.hpp"
#include "common/scenario.hpp"

namespace softgrain {

/// Acceleration of free grains [m/s^2]. Throws InputError for a periodic cell, where nothing carries weight.
Vec2 gravity_of(const Scenario& scenario, const Packing& packing);

}  // namespace softgrain
