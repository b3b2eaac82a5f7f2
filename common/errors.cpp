#include "common/errors.hpp"

#include <fmt/format.h>

namespace softgrain {

DivergedError::DivergedError(int grain_index, const std::string& what, double when, const std::string& why)
    : std::runtime_error(grain_index >= 0 ? fmt::format("diverged: {} of grain {} at t = {:.6g}: {}", what,
                                                        grain_index, when, why)
                                          : fmt::format("diverged: {} at t = {:.6g}: {}", what, when, why)),
      grain(grain_index),
      quantity(what),
      time(when) {}

}  // namespace softgrain
