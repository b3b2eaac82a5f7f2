#pragma once
// Clumps of a grain class as keys and as plain data.
#include <span>
#include <string>
#include <vector>

#include "common/disc.hpp"
#include "common/io/scenario_errors.hpp"
#include "common/io/scenario_table.hpp"

namespace softgrain::scenario_io {

/// By the keys clump, or clump_discs and clump_elongation, of a [[grain_class]]; empty without them or with
/// an error.
std::vector<Disc> clump_of(const CheckedTable& grain_class, ErrorList& errors);

/// What clump_of() reads back to the same discs.
std::string clump_text(std::span<const Disc> discs);

}  // namespace softgrain::scenario_io
