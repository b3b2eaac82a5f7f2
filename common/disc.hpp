#pragma once
#include "common/vec.hpp"

namespace softgrain {

struct Disc {
    Vec2 center;    ///< [m]
    double radius;  ///< [m]
};

}  // namespace softgrain
