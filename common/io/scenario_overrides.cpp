#include "common/io/scenario_overrides.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <vector>

namespace softgrain::scenario_io {
namespace {

std::vector<std::string_view> split(std::string_view key) {
    std::vector<std::string_view> parts;
    for (std::size_t start = 0;;) {
        const std::size_t dot = key.find('.', start);
        parts.push_back(key.substr(start, dot - start));
        if (dot == key.npos) return parts;
        start = dot + 1;
    }
}

std::optional<std::size_t> as_index(std::string_view text) {
    std::size_t index = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), index);
    if (result.ec != std::errc{} || result.ptr != text.data() + text.size()) return std::nullopt;
    return index;
}

void mark(Node& node, const Place& place) {
    node.place = place;
    node.key_place = place;
    for (Node& child : node.children) mark(child, place);
}

Node value_node(std::string_view text, std::string_view key, const Place& place) {
    Node node = parse_value(text).value_or(Node{});
    if (node.key.empty()) {
        node.kind = Node::Kind::scalar;
        node.scalar = std::string(text);
    }
    node.key = key;
    node.written = text;
    mark(node, place);
    return node;
}

bool is_rate(std::string_view key) {
    return key == "strain_rate" || key == "inertial_number";
}

/// The target of a stress stage.
bool is_target(std::string_view key) {
    return key == "pressure" || key == "stress_xx" || key == "stress_yy";
}

/// True if an option for `key` of `table` takes the place of `other`.
bool replaces(std::string_view table, std::string_view key, std::string_view other) {
    if (key == other) return false;
    if (table == "loading")
        return (key.starts_with("until_") && other.starts_with("until_")) ||
               (is_rate(key) && is_rate(other)) ||
               (is_target(key) && is_target(other) && (key == "pressure" || other == "pressure"));
    return table == "packing" && key == "path";
}

/// The member to set: "" or why there is none. Makes tables on the way.
struct Target {
    Node* table = nullptr;
    std::string why;
};

Target find_target(Node& document, std::span<const std::string_view> parts, const Place& place) {
    Node* at = &document;
    std::string path;
    for (const std::string_view part : parts.first(parts.size() - 1)) {
        if (at->kind == Node::Kind::array) {
            const auto index = as_index(part);
            if (!index)
                return {nullptr, fmt::format("'{}' must be the number of a [[{}]], from 0", part, path)};
            if (*index >= at->children.size())
                return {nullptr, fmt::format("there is no {} {}, the last is {}", path, *index,
                                             static_cast<std::ptrdiff_t>(at->children.size()) - 1)};
            at = &at->children[*index];
        } else if (at->kind == Node::Kind::table) {
            Node* next = at->find(part);
            if (next == nullptr) {
                Node made;
                made.key = part;
                mark(made, place);
                at->children.push_back(std::move(made));
                next = &at->children.back();
            }
            at = next;
        }
        path += path.empty() ? part : fmt::format(".{}", part);
        if (at->kind != Node::Kind::table && at->kind != Node::Kind::array)
            return {nullptr, fmt::format("'{}' is not a table", path)};
    }
    if (at->kind != Node::Kind::table)
        return {nullptr, fmt::format("'{}' has several stages, write {}.0.{}", path, path, parts.back())};
    return {at, {}};
}

void apply(Node& document, std::string_view key, std::string_view value, const Place& place,
           ErrorList& errors) {
    const std::vector<std::string_view> parts = split(key);
    if (std::any_of(parts.begin(), parts.end(), [](std::string_view part) { return part.empty(); }))
        return errors.add(place, "", "a key is words joined by points, as material.density");
    if (parts.size() > 3)
        return errors.add(place, "", "a key has at most three parts, as loading.0.until_strain");
    const Target target = find_target(document, parts, place);
    if (target.table == nullptr) return errors.add(place, "", target.why);
    std::erase_if(target.table->children, [&](const Node& other) {
        return other.key == parts.back() ||
               (other.place.option.empty() && replaces(parts.front(), parts.back(), other.key));
    });
    target.table->children.push_back(value_node(value, parts.back(), place));
}

}  // namespace

void apply_overrides(Node& document, std::span<const std::string> overrides, ErrorList& errors) {
    int order = 0;
    for (const std::string& text : overrides) {
        const bool bad = find_bad_utf8(text).has_value() ||
                         std::any_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; });
        const std::size_t equals = bad ? text.npos : text.find('=');
        const Place place{++order, 1, bad ? "..." : shown(text.substr(0, equals == 0 ? text.npos : equals))};
        if (bad)
            errors.add(place, "", "must be one line of UTF-8 text");
        else if (equals == text.npos)
            errors.add(place, "", "expected KEY=VALUE, as material.density=2");
        else
            apply(document, std::string_view(text).substr(0, equals),
                  std::string_view(text).substr(equals + 1), place, errors);
    }
}

}  // namespace softgrain::scenario_io
