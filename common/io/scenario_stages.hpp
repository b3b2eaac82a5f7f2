#pragma once
// A loading stage as keys and as plain data.
#include <algorithm>
#include <optional>

#include "common/scenario.hpp"
#include "common/stage_plan.hpp"

namespace softgrain::scenario_io {

LoadingStage stage_of(const Settings& settings);
/// What stage_of() reads back to the same stage.
Settings settings_of(const LoadingStage& stage);

/// The position of one of the schema's words.
template <class Names>
int position_in(const Names& names, std::string_view word) {
    return static_cast<int>(std::find(names.begin(), names.end(), word) - names.begin());
}

inline std::optional<double> optional_number(const Settings& settings, std::string_view key) {
    return settings.has(key) ? std::optional(settings.number(key)) : std::nullopt;
}

inline void set_optional(Settings& settings, std::string_view key, const std::optional<double>& value) {
    if (value) settings.set(key, *value);
}

}  // namespace softgrain::scenario_io
