#pragma once
// Options `--set KEY=VALUE`, applied to the document before it is checked.
#include <span>
#include <string>

#include "common/io/scenario_document.hpp"
#include "common/io/scenario_errors.hpp"

namespace softgrain::scenario_io {

/// VALUE is read as TOML, a bare word as text. A key that excludes others of its table takes their place in
/// the file: an `until_...` the other ends of the stage, `strain_rate` and `inertial_number` each other,
/// `packing.path` the generator's keys.
void apply_overrides(Node& document, std::span<const std::string> overrides, ErrorList& errors);

}  // namespace softgrain::scenario_io
