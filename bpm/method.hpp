#pragma once
// The bonded-particle method as a row of the table of methods.
#include "common/solver.hpp"

namespace softgrain::bpm {

/// Name "bpm".
const Method& method();

}  // namespace softgrain::bpm
