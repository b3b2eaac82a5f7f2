#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "common/errors.hpp"
#include "common/io/scenario_clumps.hpp"
#include "common/io/scenario_driven.hpp"
#include "common/io/scenario_file.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_stages.hpp"
#include "common/packing/generators.hpp"

namespace softgrain {
namespace {

using namespace scenario_io;
using scenario_io::settings_of;

std::string toml_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            out += fmt::format("\\{}", c);
        else if (static_cast<unsigned char>(c) < ' ' || c == 0x7F)
            out += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
        else
            out += c;
    }
    return out + '"';
}

/// Shortest digits that read back to the same value; a number never looks like an integer.
std::string as_toml(const Value& value) {
    if (const auto* text = std::get_if<std::string>(&value)) return toml_text(*text);
    if (const auto* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
    if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
    const std::string digits = fmt::format("{}", std::get<double>(value));
    return digits.find_first_of(".en") == digits.npos ? digits + ".0" : digits;
}

std::string note(const KeySpec& key) {
    std::string limits = key.choices.empty() ? describe(key.range) : join(key.choices);
    if (!limits.empty()) limits = fmt::format("; {}", limits);
    return fmt::format("{}{}{}", key.unit.empty() ? "" : fmt::format("[{}] ", key.unit), key.help, limits);
}

std::string written(const Settings& settings, std::span<const KeySpec> keys) {
    std::string out;
    for (const KeySpec& key : keys)
        if (settings.has(key.name))
            out += fmt::format("{} = {}  # {}\n", key.name, as_toml(settings.values().find(key.name)->second),
                               note(key));
        else
            out += fmt::format("# {}: not given; {}\n", key.name, note(key));
    return out;
}

Settings settings_of(const Material& m) {
    Settings s;
    s.set("youngs_modulus", m.youngs_modulus);
    s.set("poisson_ratio", m.poisson_ratio);
    s.set("density", m.density);
    s.set("friction", m.friction);
    s.set("wall_friction", m.wall_friction);
    s.set("cohesion", m.cohesion);
    set_optional(s, "yield_stress", m.yield_stress);
    return s;
}

Settings settings_of(const GrainClass& c) {
    Settings s;
    s.set("name", c.name);
    s.set("share", c.share);
    s.set("youngs_modulus", c.material.youngs_modulus);
    s.set("poisson_ratio", c.material.poisson_ratio);
    s.set("density", c.material.density);
    set_optional(s, "yield_stress", c.material.yield_stress);
    s.set("aspect_ratio", c.aspect_ratio);
    if (!c.clump.empty()) s.set("clump", clump_text(c.clump));
    return s;
}

Settings settings_of(const PackingSpec& p) {
    Settings s;
    if (p.path) {
        s.set("path", p.path->string());
        return s;
    }
    s.set("generator", std::string(generator_names[static_cast<std::size_t>(p.generator)]));
    s.set("size_law", std::string(size_law_names[static_cast<std::size_t>(p.size_law)]));
    s.set("count", std::int64_t{p.count});
    s.set("radius_mean", p.radius_mean);
    s.set("radius_deviation", p.radius_deviation);
    s.set("radius_min", p.radius_min);
    s.set("radius_max", p.radius_max);
    s.set("fractal_dimension", p.fractal_dimension);
    s.set("small_share", p.small_share);
    set_optional(s, "packing_fraction", p.packing_fraction);
    set_region(s, p.region);
    return s;
}

Settings settings_of(const Sampling& sampling) {
    Settings s;
    s.set("strain_interval", sampling.strain_interval);
    s.set("average_window", sampling.average_window);
    s.set("frame_every", std::int64_t{sampling.frame_every});
    s.set("outlines", sampling.outlines);
    s.set("contacts", sampling.contacts);
    s.set("parts", sampling.parts);
    s.set("measures", fmt::format("{}", fmt::join(sampling.measures, ", ")));
    set_optional(s, "time_interval", sampling.time_interval);
    return s;
}

Settings settings_of(const Watch& watch) {
    Settings s;
    s.set("action", std::string(watch_action_names[watch.stop ? 1 : 0]));
    set_optional(s, "energy_residual", watch.energy_residual);
    set_optional(s, "momentum", watch.momentum);
    set_optional(s, "penetration", watch.penetration);
    set_optional(s, "unconverged", watch.unconverged);
    set_optional(s, "lost_contacts", watch.lost_contacts);
    return s;
}

/// One entry for each time that the table is written.
std::vector<Settings> contents(const Scenario& scenario, std::string_view table) {
    Settings s;
    if (table.empty()) s.set("title", scenario.title);
    if (table == "random") s.set("seed", static_cast<std::int64_t>(scenario.seed));
    if (table == "material") return {settings_of(scenario.material)};
    if (table == "packing") return {settings_of(scenario.packing)};
    if (table == "box") {
        set_optional(s, "width", scenario.box.width);
        set_optional(s, "height", scenario.box.height);
        s.set("periodic", scenario.box.periodic);
        s.set("gravity_x", scenario.box.gravity.x());
        s.set("gravity_y", scenario.box.gravity.y());
    }
    if (table == "sampling") return {settings_of(scenario.sampling)};
    if (table == "watch") return {settings_of(scenario.watch)};
    const auto each = [](const auto& entries) {
        std::vector<Settings> all;
        for (const auto& entry : entries) all.push_back(settings_of(entry));
        return all;
    };
    if (table == "grain_class") return each(scenario.classes);
    if (table == "driven") return each(scenario.driven);
    if (table == "loading") return each(scenario.loading);
    return {s};
}

std::string header(const TableSpec& table) {
    if (table.name.empty()) return {};
    return table.repeated ? fmt::format("[[{}]]", table.name) : fmt::format("[{}]", table.name);
}

std::string_view type_name(KeyType type) {
    switch (type) {
        case KeyType::boolean:
            return "boolean";
        case KeyType::integer:
            return "integer";
        case KeyType::number:
            return "number";
        case KeyType::text:
            break;
    }
    return "text";
}

std::string described(std::span<const KeySpec> keys) {
    std::string out;
    for (const KeySpec& key : keys) {
        const bool optional = std::holds_alternative<std::monostate>(key.default_value);
        out += fmt::format("  {:<34} {:<8} {:<12} {}\n", key.name, type_name(key.type),
                           optional ? "-" : as_toml(key.default_value), note(key));
    }
    return out;
}

}  // namespace

std::string write_scenario(const Scenario& scenario, std::span<const MethodKeys> methods) {
    std::string out;
    for (const TableSpec& table : core_tables())
        for (const Settings& settings : contents(scenario, table.name)) {
            if (!table.name.empty()) out += fmt::format("\n# {}\n{}\n", table.help, header(table));
            out += written(settings, table.keys);
        }
    for (const MethodKeys& method : methods) {
        const auto it = scenario.method_settings.find(method.name);
        out += fmt::format("\n[{}]\n", method.name);
        out +=
            written(it == scenario.method_settings.end() ? Settings(method.keys) : it->second, method.keys);
    }
    return out;
}

bool says_the_same(std::string_view written, std::string_view now, std::span<const MethodKeys> methods,
                   std::string_view method) {
    if (written == now) return true;
    const auto own = std::ranges::find(methods, method, &MethodKeys::name);
    const auto meaning = [&](std::string_view text) {
        return write_scenario(parse_scenario(text, "", {}, methods), {own, own == methods.end() ? 0U : 1U});
    };
    try {
        return meaning(written) == meaning(now);
    } catch (const InputError&) {
        return false;
    }
}

std::string describe_keys(std::span<const MethodKeys> methods) {
    std::string out =
        fmt::format("  {:<34} {:<8} {:<12} {}\n", "key", "type", "default", "[unit] meaning; allowed");
    for (const TableSpec& table : core_tables())
        out += (table.name.empty() ? "" : fmt::format("\n{}  {}\n", header(table), table.help)) +
               described(table.keys);
    for (const MethodKeys& method : methods)
        out += fmt::format("\n[{}]  Settings of this method only.\n{}", method.name, described(method.keys));
    return out;
}

}  // namespace softgrain
