#include "common/io/scenario_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "common/errors.hpp"

// toml++ 3.3 only asserts on some malformed headers ("[" and a line break) and would then run on past its own
// invariants. Its assertion is made to throw, in release builds too.
namespace {
struct TomlAssertion {};
[[noreturn]] void fail_toml_assertion() {
    throw TomlAssertion{};
}
}  // namespace
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? static_cast<void>(0) : fail_toml_assertion())
#define TOML_MAX_NESTED_VALUES 4  // the library recurses through nested values
#include <toml++/toml.h>

namespace softgrain::scenario_io {
namespace {

constexpr int deepest_table = 4;  // nothing in a scenario lies deeper; what does is reported by its parent

Place place_of(const toml::source_region& region) {
    return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), {}};
}

std::string_view name_of_other(toml::node_type type) {
    switch (type) {
        case toml::node_type::date:
            return "a date";
        case toml::node_type::time:
            return "a time";
        default:
            return "a date and time";
    }
}

Node converted(const toml::node& from, int depth) {
    Node node;
    node.place = place_of(from.source());
    if (const auto* table = from.as_table()) {
        if (depth < deepest_table)
            for (const auto& [key, value] : *table) {
                Node child = converted(value, depth + 1);
                child.key = std::string(key.str());
                child.key_place = place_of(key.source());
                node.children.push_back(std::move(child));
            }
        return node;
    }
    if (const auto* array = from.as_array()) {
        node.kind = Node::Kind::array;
        if (depth < deepest_table)
            for (const auto& value : *array) node.children.push_back(converted(value, depth + 1));
        return node;
    }
    node.kind = Node::Kind::scalar;
    if (const auto* text = from.as_string())
        node.scalar = text->get();
    else if (const auto* integer = from.as_integer())
        node.scalar = integer->get();
    else if (const auto* number = from.as_floating_point())
        node.scalar = number->get();
    else if (const auto* boolean = from.as_boolean())
        node.scalar = boolean->get();
    else {
        node.kind = Node::Kind::other;
        node.other_name = name_of_other(from.type());
    }
    return node;
}

/// Line and column, in characters, of a byte.
Place place_of_byte(std::string_view text, std::size_t offset) {
    const std::string_view before = text.substr(0, offset);
    const auto line_start = before.rfind('\n') + 1;  // npos + 1 is 0
    const auto is_character = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; };
    return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
            1 + static_cast<int>(std::count_if(before.begin() + static_cast<std::ptrdiff_t>(line_start),
                                               before.end(), is_character)),
            {}};
}

std::optional<std::size_t> find_long_line(std::string_view text) {
    std::size_t start = 0;
    while (start < text.size()) {
        const std::size_t end = std::min(text.find('\n', start), text.size());
        if (end - start > longest_line) return start + longest_line;
        start = end + 1;
    }
    return std::nullopt;
}

[[noreturn]] void refuse(const std::string& name, const Place& place, std::string_view why) {
    throw InputError(fmt::format("{}:{}:{}: {}", name, place.line, place.column, why));
}

/// The library's text without its "Error while parsing ...: ".
std::string_view reason(std::string_view description) {
    constexpr std::string_view prefix = "Error while parsing";
    const auto colon = description.find(": ");
    return description.starts_with(prefix) && colon != description.npos ? description.substr(colon + 2)
                                                                        : description;
}

/// Place of the header at which the library asserts: the last line of the shortest text that asserts.
Place place_of_assertion(std::string_view text) {
    std::vector<std::size_t> line_start{0};
    for (std::size_t k = 0; k < text.size(); ++k)
        if (text[k] == '\n') line_start.push_back(k + 1);
    const auto asserts_before = [&](std::size_t line) {
        try {
            static_cast<void>(
                toml::parse(line < line_start.size() ? text.substr(0, line_start[line]) : text));
        } catch (const toml::parse_error&) {
            return false;
        } catch (const TomlAssertion&) {
            return true;
        }
        return false;
    };
    std::size_t without = 0;
    std::size_t with = line_start.size();
    while (with - without > 1) {
        const std::size_t middle = (with + without) / 2;
        (asserts_before(middle) ? with : without) = middle;
    }
    const std::size_t bracket = std::min(text.find('[', line_start[without]), text.size());
    return place_of_byte(text, bracket);
}

}  // namespace

const Node* Node::find(std::string_view name) const {
    const auto it =
        std::find_if(children.begin(), children.end(), [&](const Node& n) { return n.key == name; });
    return it == children.end() ? nullptr : &*it;
}
Node* Node::find(std::string_view name) {
    return const_cast<Node*>(std::as_const(*this).find(name));
}

std::string read_document(const std::filesystem::path& path, std::string_view what) {
    std::error_code status;
    if (!std::filesystem::exists(path, status))
        throw InputError(fmt::format("{}: there is no such {} file", path.string(), what));
    std::ifstream file(path, std::ios::binary);
    if (std::filesystem::is_directory(path, status) || !file)
        throw InputError(fmt::format("{}: cannot be read as a {} file", path.string(), what));
    std::string text(largest_document + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) throw InputError(fmt::format("{}: reading stopped early", path.string()));
    text.resize(static_cast<std::size_t>(file.gcount()));
    return text;
}

Node parse_document(std::string_view text, const std::string& name) {
    if (text.size() > largest_document)
        throw InputError(fmt::format("{}: a scenario has at most {} bytes", name, largest_document));
    if (const auto bad = find_bad_utf8(text)) refuse(name, place_of_byte(text, *bad), "not UTF-8 text");
    if (const auto at = find_long_line(text))
        refuse(name, place_of_byte(text, *at), fmt::format("a line has at most {} bytes", longest_line));
    try {
        const toml::table document = toml::parse(text);
        return converted(document, 0);
    } catch (const toml::parse_error& error) {
        refuse(name, place_of(error.source()),
               fmt::format("not valid TOML: {}", reason(error.description())));
    } catch (const TomlAssertion&) {
        refuse(name, place_of_assertion(text), "not valid TOML: expected a table's name after '['");
    }
}

std::optional<Node> parse_value(std::string_view text) {
    if (text.size() > longest_line || text.find('\n') != text.npos) return std::nullopt;
    try {
        const toml::table document = toml::parse(fmt::format("value = {}", text));
        Node node = converted(document, 0);
        if (node.children.size() != 1) return std::nullopt;
        return std::move(node.children.front());
    } catch (const toml::parse_error&) {
        return std::nullopt;
    } catch (const TomlAssertion&) {
        return std::nullopt;
    }
}

std::optional<std::size_t> find_bad_utf8(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    for (std::size_t k = 0; k < text.size();) {
        const unsigned first = byte(k);
        const std::size_t length = first < 0x80                     ? 1
                                   : first >= 0xC2 && first <= 0xDF ? 2
                                   : first >= 0xE0 && first <= 0xEF ? 3
                                   : first >= 0xF0 && first <= 0xF4 ? 4
                                                                    : 0;
        if (length == 0 || k + length > text.size()) return k;
        for (std::size_t m = 1; m < length; ++m)
            if ((byte(k + m) & 0xC0U) != 0x80U) return k;
        if (length > 2) {  // over-long forms, surrogates, beyond U+10FFFF
            const unsigned second = byte(k + 1);
            if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) ||
                (first == 0xF0 && second < 0x90) || (first == 0xF4 && second > 0x8F))
                return k;
        }
        k += length;
    }
    return std::nullopt;
}

std::string shown(std::string_view text) {
    constexpr std::size_t longest = 80;
    std::size_t length = std::min(text.size(), longest);
    while (length < text.size() && length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U)
        --length;  // not within a character
    std::string out(text.substr(0, length));
    std::replace_if(
        out.begin(), out.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7F; }, ' ');
    return length < text.size() ? out + "..." : out;
}

std::string describe(const Node& node) {
    switch (node.kind) {
        case Node::Kind::table:
            return "a table";
        case Node::Kind::array:
            return "an array";
        case Node::Kind::other:
            return std::string(node.other_name);
        case Node::Kind::scalar:
            break;
    }
    if (const auto* text = std::get_if<std::string>(&node.scalar))
        return fmt::format("the text \"{}\"", shown(*text));
    if (const auto* integer = std::get_if<std::int64_t>(&node.scalar))
        return fmt::format("the integer {}", *integer);
    if (const auto* number = std::get_if<double>(&node.scalar)) return fmt::format("the number {}", *number);
    return std::get<bool>(node.scalar) ? "true" : "false";
}

}  // namespace softgrain::scenario_io
