#pragma once
// Checks one table of the document against its keys.
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "common/io/scenario_document.hpp"
#include "common/io/scenario_errors.hpp"
#include "common/settings.hpp"

namespace softgrain::scenario_io {

/// A table's values with defaults filled in, and where each given one was written.
struct CheckedTable {
    struct Given {
        Place place;  ///< of the value
        bool sound;   ///< passed its own checks
    };

    std::string path;  ///< "material", "loading.0"
    Place place;       ///< of the table, or of the document if it is not there
    Settings settings;
    std::map<std::string, Given, std::less<>> given;

    bool has(std::string_view key) const { return given.find(key) != given.end(); }
    /// Where the key was given, else the table.
    const Place& place_of(std::string_view key) const;
    /// No error was found yet in these keys, so that they can be compared.
    bool sound(std::initializer_list<std::string_view> keys) const;
    std::string full(std::string_view key) const;
};

/// `node` may be null: every key at its default. Unknown keys are left to report_unknown.
CheckedTable check_table(const Node* node, const std::string& path, std::span<const KeySpec> keys,
                         ErrorList& errors);

/// The allowed word that `wrong` most likely stands for, or "".
std::string_view suggest(std::string_view wrong, std::span<const std::string_view> allowed);

}  // namespace softgrain::scenario_io
