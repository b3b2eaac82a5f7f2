#include "common/io/scenario_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <vector>

#include "common/io/scenario_schema.hpp"

namespace softgrain::scenario_io {
namespace {

/// Edits (insert, delete, replace) that turn a into b.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// The node's value in the key's type; nothing if it has another.
std::optional<Value> in_type(const Node& node, KeyType type) {
    if (type == KeyType::text && !node.place.option.empty() && node.kind != Node::Kind::table &&
        node.kind != Node::Kind::array && !std::holds_alternative<std::string>(node.scalar))
        return Value(node.written);  // `--set title=2024` means the text
    if (node.kind != Node::Kind::scalar) return std::nullopt;
    switch (type) {
        case KeyType::boolean:
            if (std::holds_alternative<bool>(node.scalar)) return node.scalar;
            break;
        case KeyType::integer:
            if (std::holds_alternative<std::int64_t>(node.scalar)) return node.scalar;
            break;
        case KeyType::number:
            if (std::holds_alternative<double>(node.scalar)) return node.scalar;
            if (const auto* integer = std::get_if<std::int64_t>(&node.scalar))
                return Value(static_cast<double>(*integer));
            break;
        case KeyType::text:
            if (std::holds_alternative<std::string>(node.scalar)) return node.scalar;
            break;
    }
    return std::nullopt;
}

bool inside(double value, const Range& range) {
    return (range.open_min ? value > range.min : value >= range.min) &&
           (range.open_max ? value < range.max : value <= range.max);
}

/// What is wrong with a value of the right type, "" if nothing.
std::string complaint(const Value& value, const KeySpec& key) {
    if (const auto* number = std::get_if<double>(&value)) {
        if (!std::isfinite(*number)) return fmt::format("must be a finite number, got {}", *number);
        if (!inside(*number, key.range))
            return fmt::format("must be {}, got {}", describe(key.range), *number);
    }
    if (const auto* integer = std::get_if<std::int64_t>(&value))
        if (!inside(static_cast<double>(*integer), key.range))
            return fmt::format("must be {}, got {}", describe(key.range), *integer);
    if (const auto* text = std::get_if<std::string>(&value); text != nullptr && !key.choices.empty()) {
        if (std::find(key.choices.begin(), key.choices.end(), *text) == key.choices.end()) {
            const std::string_view meant = suggest(*text, key.choices);
            return fmt::format("must be one of {}, got \"{}\"{}", join(key.choices), shown(*text),
                               meant.empty() ? "" : fmt::format(" (did you mean '{}'?)", meant));
        }
    }
    return {};
}

}  // namespace

const Place& CheckedTable::place_of(std::string_view key) const {
    const auto it = given.find(key);
    return it == given.end() ? place : it->second.place;
}

bool CheckedTable::sound(std::initializer_list<std::string_view> keys) const {
    return std::all_of(keys.begin(), keys.end(), [&](std::string_view key) {
        const auto it = given.find(key);
        return it == given.end() || it->second.sound;
    });
}

std::string CheckedTable::full(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

CheckedTable check_table(const Node* node, const std::string& path, std::span<const KeySpec> keys,
                         ErrorList& errors) {
    CheckedTable table{path, node == nullptr ? Place{} : node->place, Settings(keys), {}};
    if (node == nullptr) return table;
    for (const KeySpec& key : keys) {
        const Node* given = node->find(key.name);
        if (given == nullptr) continue;
        const std::optional<Value> value = in_type(*given, key.type);
        const std::string wrong =
            value ? complaint(*value, key)
                  : fmt::format("must be {}, got {}", describe(key.type), describe(*given));
        if (wrong.empty())
            table.settings.set(key.name, *value);
        else
            errors.add(given->place, table.full(key.name), wrong);
        table.given.emplace(key.name, CheckedTable::Given{given->place, wrong.empty()});
    }
    return table;
}

std::string_view suggest(std::string_view wrong, std::span<const std::string_view> allowed) {
    std::string_view best;
    if (wrong.size() > 100) return best;
    std::size_t least = std::max<std::size_t>(2, wrong.size() / 3) + 1;
    for (const std::string_view word : allowed) {
        const std::size_t distance = edit_distance(wrong, word);
        if (distance < least && distance < word.size()) {
            least = distance;
            best = word;
        }
    }
    return best;
}

}  // namespace softgrain::scenario_io
