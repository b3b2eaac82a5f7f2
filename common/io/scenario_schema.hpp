#pragma once
// The tables that every scenario has, whatever the method.
#include <array>
#include <span>
#include <string>
#include <string_view>

#include "common/scenario.hpp"
#include "common/settings.hpp"

namespace softgrain::scenario_io {

inline constexpr std::array<std::string_view, 6> size_law_names{"gaussian", "fractal", "uniform_volume",
                                                                "single",   "uniform", "two_sizes"};
/// In the order of LoadingKind.
inline constexpr std::array<std::string_view, 10> loading_kind_names{
    "isotropic", "oedometric", "hold",   "shear", "gradient",
    "uniaxial",  "biaxial",    "stress", "probe", "repeat"};
inline constexpr std::array<std::string_view, 2> axis_names{"x", "y"};
inline constexpr std::array<std::string_view, 2> region_names{"disc", "rectangle"};
inline constexpr std::array<std::string_view, 2> driven_kind_names{"ring", "row"};
inline constexpr std::array<std::string_view, 2> watch_action_names{"warn", "stop"};

struct TableSpec {
    std::string_view name;  ///< "" for the keys before the first table
    std::string_view help;
    std::span<const KeySpec> keys;
    bool repeated = false;  ///< an array of tables, [[name]]
};

/// In the order in which they are written.
std::span<const TableSpec> core_tables();
/// Throws std::logic_error if there is none.
const TableSpec& core_table(std::string_view name);

/// By the key of [packing].
Generator generator_of(const Settings& packing);

/// "> 0", ">= 0 and <= 0.5", or "" for any number.
std::string describe(const Range& range);
/// "a number", "an integer", "a text", "true or false".
std::string_view describe(KeyType type);
/// "gaussian, fractal, single".
std::string join(std::span<const std::string_view> words);

}  // namespace softgrain::scenario_io
