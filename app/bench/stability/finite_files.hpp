#pragma once
// Looks for values that are not finite in all files of a run.
#include <filesystem>
#include <optional>
#include <string>

#include "common/solver.hpp"

namespace softgrain::bench {

/// "history.csv: kinetic_energy, row 3", if there is such a value. A history may have nan in the columns that
/// the method does not give and in inertial_number, which is not defined without pressure; measures may have
/// nan in the strains of triangles that have no area. Throws InputError if a file cannot be read.
std::optional<std::string> not_finite_in_run(const std::filesystem::path& folder, const Method& method);

}  // namespace softgrain::bench
