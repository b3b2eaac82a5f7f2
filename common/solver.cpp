#include "common/solver.hpp"

#include <stdexcept>

namespace softgrain {

Mat2 Solver::cell_stress() const {
    throw std::logic_error("this method was asked for the stress of a periodic cell, which it cannot have");
}

}  // namespace softgrain
