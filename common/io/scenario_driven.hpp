#pragma once
// [[driven]] and the region keys of [packing]: tables to plain data and back, and what they need.
#include <optional>

#include "common/io/scenario_table.hpp"
#include "common/scenario.hpp"

namespace softgrain::scenario_io {

/// Keys of the other shape or kind must not be there, its own must.
void check_region(const CheckedTable& packing, const CheckedTable& box, ErrorList& errors);
void check_driven(const CheckedTable& driven, ErrorList& errors);

std::optional<PackingRegion> region_of(const Settings& packing, const Settings& box);
void set_region(Settings& packing, const std::optional<PackingRegion>& region);

DrivenGrains driven_of(const Settings& driven);
Settings settings_of(const DrivenGrains& driven);

}  // namespace softgrain::scenario_io
