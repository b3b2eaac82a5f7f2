#pragma once
// A TOML text as a plain tree with positions. Only its source file sees the TOML library.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/io/scenario_errors.hpp"
#include "common/settings.hpp"

namespace softgrain::scenario_io {

/// A value, table or array of the document, with the key it stands under.
struct Node {
    enum class Kind { scalar, table, array, other };

    Kind kind = Kind::table;
    std::string key;  ///< empty in an array and for the document
    Place key_place;
    Place place;                  ///< of the value
    Value scalar;                 ///< for Kind::scalar
    std::string written;          ///< what an option gave, before it was read as TOML
    std::vector<Node> children;   ///< members of a table, elements of an array
    std::string_view other_name;  ///< for Kind::other: "a date"

    Node* find(std::string_view name);
    const Node* find(std::string_view name) const;
};

/// Bytes of a scenario, and of one of its lines, beyond which it is refused.
inline constexpr std::size_t largest_document = std::size_t{1} << 20;
inline constexpr std::size_t longest_line = 2000;

/// The text of a file, at most one byte more than a document may have. `what` names it in messages:
/// "scenario". Throws InputError if it cannot be read.
std::string read_document(const std::filesystem::path& path, std::string_view what);

/// The document's tree. Throws InputError naming `name`, line and column.
Node parse_document(std::string_view text, const std::string& name);

/// A single TOML value; nothing if the text is not one.
std::optional<Node> parse_value(std::string_view text);

/// Offset of the first byte that is not UTF-8.
std::optional<std::size_t> find_bad_utf8(std::string_view text);

/// Text for a message: shortened, without line breaks.
std::string shown(std::string_view text);

/// "the integer 3", "the text \"a\"", "a table", for messages.
std::string describe(const Node& node);

}  // namespace softgrain::scenario_io
