#pragma once
// Scenario files: TOML in, plain data out, and back.
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "common/scenario.hpp"
#include "common/settings.hpp"

namespace softgrain {

/// The table of one method, [name]. The reader itself knows no method.
struct MethodKeys {
    std::string_view name;
    std::span<const KeySpec> keys;
    std::vector<KeyFault> (*faults)(const Settings&) = nullptr;  ///< between the keys, if it looks for any
};

/// Where a file that a scenario names by a relative path may lie: anywhere, or within the folder of the
/// scenario or the current one. What an absolute path or an override names may lie anywhere.
enum class NamedFiles { anywhere, inside };

/// Reads and checks a scenario. `overrides` are KEY=VALUE ("material.poisson_ratio=0.45",
/// "loading.0.until_strain=0.2"), applied before the checks; the value is TOML, a bare word is text. An
/// override of how a stage ends, how fast it goes or to which pressure takes the place of what the file says
/// about that, and `packing.path` the place of the file's generator. A relative packing.path is looked up
/// from the scenario's folder, from an override from the current one. Throws InputError: one line for each
/// error.
Scenario read_scenario(const std::filesystem::path& path, std::span<const std::string> overrides,
                       std::span<const MethodKeys> methods, NamedFiles files = NamedFiles::anywhere);

/// The same for text in memory; `name` stands for the file in messages and for relative paths.
Scenario parse_scenario(std::string_view text, const std::filesystem::path& name,
                        std::span<const std::string> overrides, std::span<const MethodKeys> methods,
                        NamedFiles files = NamedFiles::anywhere);

/// The scenario with all defaults as TOML; units and meaning as comments. Reading it gives the same scenario.
std::string write_scenario(const Scenario& scenario, std::span<const MethodKeys> methods);

/// Whether two texts of write_scenario() say the same to this method, though one may be of another version
/// with other comments or without keys that have come since. What stands in the tables of other methods does
/// not count.
bool says_the_same(std::string_view written, std::string_view now, std::span<const MethodKeys> methods,
                   std::string_view method);

/// All tables and keys as text: type, default, range, unit, meaning.
std::string describe_keys(std::span<const MethodKeys> methods);

}  // namespace softgrain
