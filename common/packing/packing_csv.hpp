#pragma once
// Packings as CSV files of x,y,r [m], and class, aspect_ratio, angle [rad] where they are needed.
#include <filesystem>

#include "common/packing/packing.hpp"

namespace softgrain {

/// Overlap of two grains (see relative_overlap), and of a grain with a wall as a share of its radius, up to
/// which a packing is accepted.
inline constexpr double tolerated_overlap = 0.01;

/// Header "x,y,r", then one grain a line; lines that start with # are comments. More columns by their names,
/// in any order: class (of 0 to classes - 1), aspect_ratio with angle (r is then that of the disc of the same
/// area), angle alone with `clumps` (by class, as in Packing). The grains lie in `box`; centres outside a
/// periodic one are wrapped. Throws InputError naming file and line.
Packing read_packing_csv(const std::filesystem::path& path, const Box& box, std::size_t classes = 1,
                         std::vector<ClumpShape> clumps = {});

/// The free grains. Digits that read back to the same bits; from the box's lower left corner; its size stands
/// in a comment. Throws OutputError.
void write_packing_csv(const std::filesystem::path& path, const Packing& packing);

}  // namespace softgrain
