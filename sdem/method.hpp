#pragma once
// The row of the table of methods.
#include "common/solver.hpp"

namespace softgrain::sdem {

/// Method "sdem".
const Method& method();

}  // namespace softgrain::sdem
