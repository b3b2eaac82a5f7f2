#pragma once
// Rigid DEM's row in the table of methods.
#include "common/solver.hpp"

namespace softgrain::rigid_dem {

const Method& method();

}  // namespace softgrain::rigid_dem
