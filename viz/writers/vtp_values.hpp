#pragma once
// Reads VTK files back to look at their values.
#include <filesystem>
#include <optional>
#include <string>

namespace softgrain {

/// Name of an array with a value that is not finite ("points" for places), if there is one. Throws InputError
/// if the file cannot be read.
std::optional<std::string> not_finite_in_vtp(const std::filesystem::path& path);

}  // namespace softgrain
