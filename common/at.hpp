#pragma once

#include <cstddef>

namespace softgrain {

/// The index k >= 0 as what standard containers are asked with.
inline std::size_t at(int k) {
    return static_cast<std::size_t>(k);
}

}  // namespace softgrain
