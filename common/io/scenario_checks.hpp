#pragma once
// Checks between the keys of a table, and between tables.
#include <filesystem>
#include <span>

#include "common/io/scenario_errors.hpp"
#include "common/io/scenario_table.hpp"
#include "common/scenario.hpp"

namespace softgrain::scenario_io {

/// `folder` is the one that a relative packing.path starts from.
void check_packing(const CheckedTable& packing, const CheckedTable& box, const std::filesystem::path& folder,
                   ErrorList& errors);
/// A relative packing.path of the file leads to no place outside its folder and the current one.
void check_inside(const CheckedTable& packing, const std::filesystem::path& folder, ErrorList& errors);
/// One of the stages; `box` tells whether there are walls or a periodic cell.
void check_stage(std::span<const CheckedTable> stages, std::size_t number, const CheckedTable& box,
                 ErrorList& errors);
/// Whether a stage of this kind may have this key of [[loading]].
bool is_for(std::string_view key, LoadingKind kind);
/// Each until_strain and until_shear lies ahead of where its stage begins, as far as that is known.
void check_course(std::span<const CheckedTable> stages, ErrorList& errors);

/// A periodic cell has no gravity.
void check_gravity(const CheckedTable& box, ErrorList& errors);

/// Every name in sampling.measures is known and stands there once.
void check_sampling(const CheckedTable& sampling, ErrorList& errors);

/// packing.path as an absolute path.
std::filesystem::path packing_file(const CheckedTable& packing, const std::filesystem::path& folder);

}  // namespace softgrain::scenario_io
