#pragma once
// Packings as CSV files of x,y,r [m].
#include <filesystem>

#include "common/packing/packing.hpp"

namespace softgrain {

/// Overlap of two discs, as a share of the sum of their radii, and of a disc with a wall, as a share of its
/// radius, up to which a packing is accepted.
inline constexpr double tolerated_overlap = 0.01;

/// Header "x,y,r", then one disc a line; lines that start with # are comments. The discs lie in `box`.
/// Throws InputError naming file and line.
Packing read_packing_csv(const std::filesystem::path& path, const Box& box);

/// Digits that read back to the same bits; from the box's lower left corner; its size stands in a comment.
/// Throws OutputError.
void write_packing_csv(const std::filesystem::path& path, const Packing& packing);

}  // namespace softgrain
