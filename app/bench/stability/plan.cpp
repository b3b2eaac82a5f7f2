#include "app/bench/stability/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "app/bench/plan_reader.hpp"
#include "common/io/scenario_schema.hpp"

namespace softgrain::bench {
namespace {

using Keys = std::vector<KeySpec>;

constexpr std::array<std::string_view, 3> long_kinds{"drift", "cycle", "rest"};

KeySpec text(std::string_view name, std::string value = "") {
    return {name, KeyType::text, Value(std::move(value)), "", ""};
}
KeySpec number(std::string_view name, double value, Range range = positive) {
    return {name, KeyType::number, value, "", "", range};
}
KeySpec count(std::string_view name, std::int64_t value, double least) {
    return {name, KeyType::integer, value, "", "", Range{least, 1e9}};
}

const Keys& random_keys() {
    static const Keys keys{count("first_seed", 1, 0), count("scenarios", 0, 0), number("cpu_time", 20.0),
                           number("wall_time", 600.0), number("memory", 8e9)};
    return keys;
}
const Keys& extremes_keys() {
    static const Keys keys{number("cpu_time", 60.0), number("wall_time", 1800.0), number("memory", 8e9)};
    return keys;
}
const Keys& extreme_keys() {
    static const Keys keys{text("name"), text("scenario"), text("set"), text("methods")};
    return keys;
}
const Keys& map_keys() {
    static const Keys keys{text("name"),
                           text("method"),
                           text("set"),
                           text("safety_key"),
                           {"factor_by_key", KeyType::boolean, Value(false), "", ""},
                           text("phi", "0.9"),
                           text("poisson_ratio", "0.3"),
                           text("size_ratio", "1.5"),
                           text("stiffness_ratio", "1"),
                           text("damping"),
                           count("grains", 12, 1),
                           count("steps", 1000, 1)};
    return keys;
}
const Keys& long_keys() {
    static const Keys keys{text("name"),
                           {"kind",
                            KeyType::text,
                            Value(std::string("drift")),
                            "",
                            "",
                            any_number,
                            {long_kinds.begin(), long_kinds.end()}},
                           text("method"),
                           text("set"),
                           number("phi", 0.9),
                           number("strain", 0.02, Range{0.0, 0.5, true}),
                           {"periodic", KeyType::boolean, Value(false), "", ""},
                           count("grains", 12, 1),
                           count("steps", 1000, 1)};
    return keys;
}

class Reader : PlanReader {
  public:
    using PlanReader::PlanReader;

    StabilityPlan read() {
        known_tables({"random", "extremes", "extreme", "map", "long"});
        StabilityPlan plan;
        const Settings random = table("random", random_keys()).settings;
        plan.random = {static_cast<int>(random.integer("first_seed")),
                       static_cast<int>(random.integer("scenarios")), limits_of(random)};
        plan.extremes.limits = limits_of(table("extremes", extremes_keys()).settings);
        for (const CheckedTable& t : tables("extreme", extreme_keys(), {})) add_extreme(t, plan);
        for (const CheckedTable& t : tables("map", map_keys(), {}))
            if (is_method(t)) add_map(t, plan);
        for (const CheckedTable& t : tables("long", long_keys(), {}))
            if (is_method(t)) add_long(t, plan);
        errors_.throw_if_any();
        return plan;
    }

  private:
    static ChildLimits limits_of(const Settings& s) {
        return {s.number("cpu_time"), s.number("wall_time"), static_cast<std::uint64_t>(s.number("memory"))};
    }

    std::string file_name_of(const CheckedTable& table) {
        std::string name = table.settings.text("name");
        if (name.empty() ||
            name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_") != std::string::npos)
            add_error(table, "name", "must be of small letters, digits and _, as it names files");
        return name;
    }

    std::vector<double> numbers_of(const CheckedTable& table, std::string_view key) {
        std::vector<double> all;
        for (const std::string& word : parts(table.settings.text(key))) {
            double value = 0.0;
            const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
            if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value))
                add_error(table, key, fmt::format("must be numbers with commas, got '{}'", word));
            all.push_back(value);
        }
        if (all.empty()) add_error(table, key, "must be at least one number");
        return all;
    }

    void add_extreme(const CheckedTable& table, StabilityPlan& plan) {
        Extreme one{file_name_of(table), file(table, "scenario"), parts(table.settings.text("set")),
                    parts(table.settings.text("methods"))};
        if (!std::filesystem::is_regular_file(one.scenario))
            add_error(table, "scenario", fmt::format("there is no file {}", one.scenario.string()));
        // An option is looked up from where the program runs.
        constexpr std::string_view packing = "packing.path=";
        for (std::string& key : one.set)
            if (key.starts_with(packing))
                key =
                    std::string(packing) + (one.scenario.parent_path() / key.substr(packing.size())).string();
        plan.extremes.extremes.push_back(std::move(one));
    }

    void add_map(const CheckedTable& table, StabilityPlan& plan) {
        MapPlan map{.name = file_name_of(table),
                    .method = table.settings.text("method"),
                    .set = parts(table.settings.text("set")),
                    .safety_key = table.settings.text("safety_key"),
                    .factor_by_key = table.settings.boolean("factor_by_key"),
                    .phi = numbers_of(table, "phi"),
                    .poisson_ratio = numbers_of(table, "poisson_ratio"),
                    .size_ratio = numbers_of(table, "size_ratio"),
                    .stiffness_ratio = numbers_of(table, "stiffness_ratio"),
                    .damping = parts(table.settings.text("damping")),
                    .grains = static_cast<int>(table.settings.integer("grains")),
                    .steps = table.settings.integer("steps")};
        if (map.damping.empty()) map.damping.emplace_back();
        plan.maps.push_back(std::move(map));
    }

    void add_long(const CheckedTable& table, StabilityPlan& plan) {
        const Settings& s = table.settings;
        const auto kind = std::ranges::find(long_kinds, s.text("kind")) - long_kinds.begin();
        LongPlan one{.name = file_name_of(table),
                     .kind = static_cast<LongKind>(kind),
                     .scene = {.method = s.text("method"),
                               .set = parts(s.text("set")),
                               .grains = static_cast<int>(s.integer("grains")),
                               .periodic = s.boolean("periodic")},
                     .phi = s.number("phi"),
                     .strain = s.number("strain"),
                     .steps = s.integer("steps")};
        plan.long_runs.push_back(std::move(one));
    }
};

}  // namespace

StabilityPlan read_stability_plan(const std::filesystem::path& path) {
    return Reader(path).read();
}

}  // namespace softgrain::bench
