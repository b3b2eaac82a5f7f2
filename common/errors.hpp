#pragma once
// The four ways a run can end early. The command line turns each into its exit code.
#include <stdexcept>
#include <string>

namespace softgrain {

/// A scenario, packing or argument that cannot be used (exit 2). The text names place and cure.
class InputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The physics left the finite world or the stable time step (exit 3).
class DivergedError : public std::runtime_error {
  public:
    DivergedError(int grain, const std::string& quantity, double time, const std::string& why);
    int grain;             ///< index of the grain, -1 if not one grain
    std::string quantity;  ///< for example "velocity"
    double time;           ///< [s]
};

/// A file could not be read or written (exit 4).
class OutputError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace softgrain
