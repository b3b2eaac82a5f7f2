#pragma once
// Springs' row in the table of methods.
#include "common/solver.hpp"

namespace softgrain::springs {

const Method& method();

}  // namespace softgrain::springs
