#include "app/bench/plan.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/bench/lists.hpp"
#include "app/methods.hpp"
#include "common/errors.hpp"
#include "common/io/scenario_document.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_table.hpp"
#include "common/observables/observable.hpp"

namespace softgrain::bench {
namespace {

using scenario_io::CheckedTable;
using scenario_io::Node;
using Keys = std::vector<KeySpec>;

KeySpec text_key(std::string_view name) {
    return {name, KeyType::text, Value{}, "", ""};
}

/// The keys of a quantity: its columns, the reference's error and what it is relative to.
struct QuantityKeys {
    std::string_view columns, error, scale;
};
constexpr std::array<QuantityKeys, quantity_count> quantity_keys{
    {{"stress", "stress_error", "stress_scale"},
     {"coordination", "coordination_error", "coordination_scale"},
     {"deviatoric", "deviatoric_error", "deviatoric_scale"},
     {"area", "area_error", "area_scale"}}};

const Keys& case_keys() {
    static const Keys keys = [] {
        Keys all;
        for (const char* name : {"name", "title", "scenario", "set", "reference", "over"})
            all.push_back(text_key(name));
        for (const QuantityKeys& one : quantity_keys)
            for (const std::string_view name : {one.columns, one.error, one.scale})
                all.push_back(text_key(name));
        return all;
    }();
    return keys;
}

const Keys& knob_keys() {
    static const Keys keys{text_key("method"), text_key("name"), text_key("key"),
                           text_key("values"), text_key("set"),  text_key("cases")};
    return keys;
}

const Keys& headline_keys() {
    static const Keys keys{text_key("case"),
                           text_key("method"),
                           text_key("against"),
                           {"error", KeyType::number, Value{}, "", "", positive},
                           {"times", KeyType::number, Value{}, "", "", positive}};
    return keys;
}

/// All columns that a run writes, without rows.
const History& run_columns() {
    static const History none = [] {
        History history;
        for (const Observable& o : observables()) history.columns[std::string(o.name)] = {};
        return history;
    }();
    return none;
}

class Reader {
  public:
    explicit Reader(const std::filesystem::path& path)
        : path_(path),
          document_(scenario_io::parse_document(scenario_io::read_document(path, "plan"), path.string())),
          errors_(path.string()) {}

    Plan read() {
        Plan plan;
        plan.source = path_;
        for (const Node& child : document_.children) known(child, {"case", "knob", "headline"});
        for (const CheckedTable& table :
             tables("case", case_keys(), {"name", "scenario", "reference", "over", "stress"}))
            plan.cases.push_back(case_of(table, plan.cases));
        for (const CheckedTable& table : tables("knob", knob_keys(), {"method", "name"}))
            add_settings(table, plan);
        for (const CheckedTable& table :
             tables("headline", headline_keys(), {"case", "method", "against", "error", "times"}))
            add_headline(table, plan);
        if (document_.find("case") == nullptr)
            errors_.add({}, "case", "is missing: write at least one [[case]]");
        if (document_.find("knob") == nullptr)
            errors_.add({}, "knob", "is missing: write at least one [[knob]]");
        errors_.throw_if_any();
        return plan;
    }

  private:
    void known(const Node& node, const std::vector<std::string_view>& words) {
        if (std::ranges::find(words, node.key) != words.end()) return;
        const std::string_view meant = scenario_io::suggest(node.key, words);
        errors_.add(node.key_place, "",
                    fmt::format("unknown key '{}', {}", scenario_io::shown(node.key),
                                meant.empty() ? "known are " + scenario_io::join(words)
                                              : fmt::format("did you mean '{}'?", meant)));
    }

    /// The sound ones of [[name]].
    std::vector<CheckedTable> tables(std::string_view name, const Keys& keys,
                                     std::initializer_list<std::string_view> needed) {
        std::vector<CheckedTable> sound;
        const Node* all = document_.find(name);
        if (all == nullptr) return sound;
        if (all->kind != Node::Kind::array) {
            errors_.add(all->place, name, fmt::format("must be tables [[{}]], got {}", name, describe(*all)));
            return sound;
        }
        std::vector<std::string_view> words;
        for (const KeySpec& key : keys) words.push_back(key.name);
        for (std::size_t k = 0; k < all->children.size(); ++k) {
            const Node& node = all->children[k];
            const std::size_t before = errors_.size();
            for (const Node& child : node.children) known(child, words);
            CheckedTable table = check_table(&node, fmt::format("{}.{}", name, k), keys, errors_);
            for (const std::string_view key : needed)
                if (!table.has(key)) errors_.add(node.place, table.full(key), "is missing");
            if (errors_.size() == before) sound.push_back(std::move(table));
        }
        return sound;
    }

    static std::string text(const CheckedTable& table, std::string_view key) {
        return table.has(key) ? table.settings.text(key) : std::string();
    }

    void add_error(const CheckedTable& table, std::string_view key, std::string_view what) {
        errors_.add(table.place_of(key), table.full(key), what);
    }

    std::filesystem::path file(const CheckedTable& table, std::string_view key) const {
        return (path_.parent_path() / table.settings.text(key)).lexically_normal();
    }

    /// "a = b" is a of a run and b of the reference, "a" the same of both.
    std::pair<Expression, Expression> of_both(const CheckedTable& table, std::string_view key,
                                              const std::optional<History>& truth) {
        const std::string& all = table.settings.text(key);
        const auto equals = all.find('=');
        const std::string left = trimmed(std::string_view(all).substr(0, equals));
        const std::string right =
            equals == std::string::npos ? left : trimmed(std::string_view(all).substr(equals + 1));
        return {checked(table, key, left, &run_columns()),
                checked(table, key, right, truth ? &*truth : nullptr)};
    }

    /// Tried on columns, unless they are not known.
    Expression checked(const CheckedTable& table, std::string_view key, const std::string& what,
                       const History* columns) {
        try {
            Expression expression(what);
            if (columns != nullptr) expression.of(*columns);
            return expression;
        } catch (const InputError& error) {
            const bool of_reference = columns != nullptr && columns != &run_columns();
            add_error(table, key,
                      fmt::format("{}{}", of_reference ? "of the reference: " : "", error.what()));
            return {};
        }
    }

    Case case_of(const CheckedTable& table, const std::vector<Case>& before) {
        Case one;
        one.name = table.settings.text("name");
        if (one.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
            add_error(table, "name", "must be of small letters, digits and _, as it names files");
        for (const Case& other : before)
            if (other.name == one.name) add_error(table, "name", "names another case already");
        one.title = table.has("title") ? table.settings.text("title") : one.name;
        one.scenario = file(table, "scenario");
        if (!std::filesystem::exists(one.scenario))
            add_error(table, "scenario", fmt::format("there is no file {}", one.scenario.string()));
        one.set = parts(text(table, "set"));
        one.reference = file(table, "reference");
        if (std::filesystem::exists(one.reference)) one.truth = read_history(one.reference);
        std::tie(one.run_over, one.reference_over) = of_both(table, "over", one.truth);
        for (std::size_t q = 0; q < quantity_count; ++q) {
            const QuantityKeys& keys = quantity_keys[q];
            if (!table.has(keys.columns)) continue;
            Quantity& quantity = one.quantities[q].emplace();
            std::tie(quantity.run, quantity.reference) = of_both(table, keys.columns, one.truth);
            const auto of_reference = [&](std::string_view key) -> std::optional<Expression> {
                if (!table.has(key)) return std::nullopt;
                return checked(table, key, table.settings.text(key), one.truth ? &*one.truth : nullptr);
            };
            quantity.error = of_reference(keys.error);
            quantity.scale = of_reference(keys.scale);
        }
        return one;
    }

    bool is_method(const CheckedTable& table) {
        const auto names = method_names();
        const std::string& name = table.settings.text("method");
        if (std::ranges::find(names, name) != names.end()) return true;
        add_error(table, "method",
                  fmt::format("must be one of {}, got \"{}\"", scenario_io::join(names), name));
        return false;
    }

    bool is_case(const CheckedTable& table, std::string_view key, const std::string& name, const Plan& plan) {
        if (std::ranges::find(plan.cases, name, &Case::name) != plan.cases.end()) return true;
        add_error(table, key, fmt::format("names no sound case: \"{}\"", name));
        return false;
    }

    void add_settings(const CheckedTable& table, Plan& plan) {
        if (!is_method(table)) return;
        Setting common;
        common.method = table.settings.text("method");
        common.knob = common.label = table.settings.text("name");
        common.set = parts(text(table, "set"));
        common.cases = parts(text(table, "cases"));
        common.line = table.place.line;
        for (const std::string& name : common.cases)
            if (!is_case(table, "cases", name, plan)) return;
        if (table.has("key") != table.has("values")) {
            add_error(table, "key", "and values are given together, or neither of them");
            return;
        }
        if (!table.has("key")) {
            add_setting(table, common, plan);
            return;
        }
        const std::string& key = table.settings.text("key");
        const std::vector<std::string> values = parts(table.settings.text("values"));
        if (values.empty()) add_error(table, "values", "must be at least one, parted by commas");
        for (const std::string& value : values) {
            Setting setting = common;
            setting.label = fmt::format("{} = {}", key.substr(key.find('.') + 1), value);
            setting.set.push_back(fmt::format("{}={}", key, value));
            add_setting(table, setting, plan);
        }
    }

    void add_setting(const CheckedTable& table, const Setting& setting, Plan& plan) {
        for (const Setting& other : plan.settings)
            if (other.method == setting.method && other.set == setting.set)
                errors_.add(table.place, table.path,
                            fmt::format("runs \"{}\" again, as line {} does: leave one of them out",
                                        setting.label, other.line));
        plan.settings.push_back(setting);
    }

    void add_headline(const CheckedTable& table, Plan& plan) {
        const Headline one{table.settings.text("case"), table.settings.text("method"),
                           table.settings.text("against"), table.settings.number("error"),
                           table.settings.number("times")};
        if (!is_method(table) || !is_case(table, "case", one.case_name, plan)) return;
        if (std::ranges::find(plan.settings, one.against, &Setting::knob) == plan.settings.end())
            add_error(table, "against", fmt::format("names no knob: \"{}\"", one.against));
        plan.headlines.push_back(one);
    }

    static std::vector<std::string_view> method_names() {
        std::vector<std::string_view> names;
        for (const Method& m : methods()) names.push_back(m.name);
        return names;
    }

    const std::filesystem::path& path_;
    Node document_;
    scenario_io::ErrorList errors_;
};

}  // namespace

bool Setting::is_for(const Case& one) const {
    return cases.empty() || std::ranges::find(cases, one.name) != cases.end();
}

std::string Setting::name() const {
    return label == knob ? knob : fmt::format("{}, {}", knob, label);
}

Plan read_plan(const std::filesystem::path& path) {
    return Reader(path).read();
}

}  // namespace softgrain::bench
