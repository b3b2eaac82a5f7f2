#include "app/bench/plan_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/methods.hpp"
#include "common/io/scenario_schema.hpp"

namespace softgrain::bench {

using scenario_io::CheckedTable;
using scenario_io::Node;

KeySpec text_key(std::string_view name) {
    return {name, KeyType::text, Value{}, "", ""};
}

std::string trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(' ') - first + 1));
}

std::vector<std::string> parts(std::string_view text) {
    std::vector<std::string> all;
    while (!text.empty()) {
        const auto comma = std::min(text.find(','), text.size());
        if (std::string word = trimmed(text.substr(0, comma)); !word.empty()) all.push_back(std::move(word));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return all;
}

PlanReader::PlanReader(const std::filesystem::path& path)
    : path_(path),
      errors_(path.string()),
      document_(scenario_io::parse_document(scenario_io::read_document(path, "plan"), path.string())) {}

void PlanReader::known(const Node& node, const std::vector<std::string_view>& words) {
    if (std::ranges::find(words, node.key) != words.end()) return;
    const std::string_view meant = scenario_io::suggest(node.key, words);
    errors_.add(node.key_place, "",
                fmt::format("unknown key '{}', {}", scenario_io::shown(node.key),
                            meant.empty() ? "known are " + scenario_io::join(words)
                                          : fmt::format("did you mean '{}'?", meant)));
}

void PlanReader::known_tables(const std::vector<std::string_view>& names) {
    for (const Node& child : document_.children) known(child, names);
}

void PlanReader::needed(std::string_view name) {
    if (document_.find(name) == nullptr)
        errors_.add({}, name, fmt::format("is missing: write at least one [[{}]]", name));
}

CheckedTable PlanReader::check(const Node* node, const std::string& name, const std::vector<KeySpec>& keys) {
    std::vector<std::string_view> words;
    for (const KeySpec& key : keys) words.push_back(key.name);
    if (node != nullptr)
        for (const Node& child : node->children) known(child, words);
    return check_table(node, name, keys, errors_);
}

CheckedTable PlanReader::table(std::string_view name, const std::vector<KeySpec>& keys) {
    return check(document_.find(name), std::string(name), keys);
}

std::vector<CheckedTable> PlanReader::tables(std::string_view name, const std::vector<KeySpec>& keys,
                                             std::initializer_list<std::string_view> required) {
    std::vector<CheckedTable> sound;
    const Node* all = document_.find(name);
    if (all == nullptr) return sound;
    if (all->kind != Node::Kind::array) {
        errors_.add(all->place, name, fmt::format("must be tables [[{}]], got {}", name, describe(*all)));
        return sound;
    }
    for (std::size_t k = 0; k < all->children.size(); ++k) {
        const Node& node = all->children[k];
        const std::size_t before = errors_.size();
        CheckedTable table = check(&node, fmt::format("{}.{}", name, k), keys);
        for (const std::string_view key : required)
            if (!table.has(key)) errors_.add(node.place, table.full(key), "is missing");
        if (errors_.size() == before) sound.push_back(std::move(table));
    }
    return sound;
}

std::string PlanReader::text(const CheckedTable& table, std::string_view key) {
    return table.has(key) ? table.settings.text(key) : std::string();
}

std::filesystem::path PlanReader::file(const CheckedTable& table, std::string_view key) const {
    return (path_.parent_path() / table.settings.text(key)).lexically_normal();
}

void PlanReader::add_error(const CheckedTable& table, std::string_view key, std::string_view what) {
    errors_.add(table.place_of(key), table.full(key), what);
}

bool PlanReader::is_method(const CheckedTable& table) {
    std::vector<std::string_view> names;
    for (const Method& m : methods()) names.push_back(m.name);
    const std::string& name = table.settings.text("method");
    if (std::ranges::find(names, name) != names.end()) return true;
    add_error(table, "method", fmt::format("must be one of {}, got \"{}\"", scenario_io::join(names), name));
    return false;
}

}  // namespace softgrain::bench
