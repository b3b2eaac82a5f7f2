#pragma once
// The material point method's row in the table of methods.
#include "common/solver.hpp"

namespace softgrain::mpm {

const Method& method();

}  // namespace softgrain::mpm
