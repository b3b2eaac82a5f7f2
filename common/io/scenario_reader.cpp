#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <vector>

#include "common/errors.hpp"
#include "common/io/measure_files.hpp"
#include "common/io/scenario_checks.hpp"
#include "common/io/scenario_clumps.hpp"
#include "common/io/scenario_document.hpp"
#include "common/io/scenario_driven.hpp"
#include "common/io/scenario_file.hpp"
#include "common/io/scenario_overrides.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_stages.hpp"
#include "common/io/scenario_table.hpp"

namespace softgrain {
namespace {

using namespace scenario_io;

constexpr std::size_t most_classes = 255;  // a grain's class is kept in a byte
constexpr std::size_t most_stages = 10000;
constexpr std::size_t most_driven = 1000;

Material material_of(const Settings& s) {
    return {s.number("youngs_modulus"),
            s.number("poisson_ratio"),
            s.number("density"),
            s.number("friction"),
            s.number("wall_friction"),
            s.number("cohesion"),
            optional_number(s, "yield_stress")};
}

GrainClass class_of(const CheckedTable& table, const Material& material, ErrorList& errors) {
    const Settings& s = table.settings;
    GrainClass grain_class{s.text("name"), s.number("share"), material, s.number("aspect_ratio")};
    Material& own = grain_class.material;
    own.youngs_modulus = optional_number(s, "youngs_modulus").value_or(material.youngs_modulus);
    own.poisson_ratio = optional_number(s, "poisson_ratio").value_or(material.poisson_ratio);
    own.density = optional_number(s, "density").value_or(material.density);
    if (s.has("yield_stress")) own.yield_stress = s.number("yield_stress");
    grain_class.clump = clump_of(table, errors);
    return grain_class;
}

PackingSpec packing_of(const CheckedTable& table, const std::filesystem::path& folder) {
    const Settings& s = table.settings;
    PackingSpec packing;
    if (s.has("path")) packing.path = packing_file(table, folder);
    packing.generator = generator_of(s);
    packing.size_law = static_cast<SizeLaw>(position_in(size_law_names, s.text("size_law")));
    packing.count = static_cast<int>(s.integer("count"));
    packing.radius_mean = s.number("radius_mean");
    packing.radius_deviation = s.number("radius_deviation");
    packing.radius_min = s.number("radius_min");
    packing.radius_max = s.number("radius_max");
    packing.fractal_dimension = s.number("fractal_dimension");
    packing.small_share = s.number("small_share");
    packing.packing_fraction = optional_number(s, "packing_fraction");
    return packing;
}

Sampling sampling_of(const Settings& s) {
    return {s.number("strain_interval"),
            s.number("average_window"),
            static_cast<int>(s.integer("frame_every")),
            s.boolean("outlines"),
            s.boolean("contacts"),
            s.boolean("parts"),
            measures_in(s.text("measures")),
            optional_number(s, "time_interval")};
}

Watch watch_of(const Settings& s) {
    return {position_in(watch_action_names, s.text("action")) == 1,
            optional_number(s, "energy_residual"),
            optional_number(s, "momentum"),
            optional_number(s, "penetration"),
            optional_number(s, "unconverged"),
            optional_number(s, "lost_contacts")};
}

/// Reads one document: checks every table, remembers every error.
class Reader {
  public:
    Reader(const Node& document, const std::filesystem::path& source, std::span<const MethodKeys> methods,
           NamedFiles files, ErrorList& errors)
        : document_(document), source_(source), methods_(methods), files_(files), errors_(errors) {
        for (const TableSpec& table : core_tables()) tables_.push_back(table);
        for (const MethodKeys& method : methods)
            tables_.push_back({.name = method.name, .help = "", .keys = method.keys});
    }

    Scenario read() {
        check_top_level();
        Scenario scenario;
        scenario.source = source_;
        scenario.title = check_table(&document_, "", core_table("").keys, errors_).settings.text("title");
        scenario.seed = static_cast<std::uint64_t>(table("random").settings.integer("seed"));
        scenario.material = material_of(table("material").settings);
        for (const CheckedTable& one : repeated("grain_class", most_classes))
            scenario.classes.push_back(class_of(one, scenario.material, errors_));
        const CheckedTable packing = table("packing");
        const CheckedTable box = table("box");
        const std::filesystem::path folder = source_.parent_path();
        check_packing(packing, box, folder, errors_);
        if (files_ == NamedFiles::inside) check_inside(packing, folder, errors_);
        check_region(packing, box, errors_);
        scenario.packing = packing_of(packing, folder);
        scenario.packing.region = region_of(packing.settings, box.settings);
        for (const CheckedTable& driven : repeated("driven", most_driven)) {
            check_driven(driven, errors_);
            scenario.driven.push_back(driven_of(driven.settings));
        }
        scenario.box = {optional_number(box.settings, "width"),
                        optional_number(box.settings, "height"),
                        box.settings.boolean("periodic"),
                        {box.settings.number("gravity_x"), box.settings.number("gravity_y")}};
        check_gravity(box, errors_);
        scenario.loading = stages(box);
        const CheckedTable sampling = table("sampling");
        check_sampling(sampling, errors_);
        scenario.sampling = sampling_of(sampling.settings);
        scenario.watch = watch_of(table("watch").settings);
        for (const MethodKeys& method : methods_)
            scenario.method_settings.emplace(method.name, method_settings(method));
        return scenario;
    }

  private:
    const TableSpec& spec(std::string_view name) const {
        return *std::find_if(tables_.begin(), tables_.end(),
                             [&](const TableSpec& table) { return table.name == name; });
    }

    /// The table if it is there and a table; anything else is an error.
    const Node* table_node(std::string_view name) {
        const Node* node = document_.find(name);
        if (node == nullptr || node->kind == Node::Kind::table) return node;
        errors_.add(node->place, name,
                    fmt::format("must be one table, write [{}], got {}", name, describe(*node)));
        return nullptr;
    }

    CheckedTable table(std::string_view name) {
        const Node* node = table_node(name);
        const TableSpec& keys = spec(name);
        if (node != nullptr) report_unknown(*node, std::string(name), keys);
        return check_table(node, std::string(name), keys.keys, errors_);
    }

    Settings method_settings(const MethodKeys& method) {
        const CheckedTable own = table(method.name);
        if (method.faults != nullptr)
            for (const KeyFault& fault : method.faults(own.settings))
                if (own.sound({fault.key}))
                    errors_.add(own.place_of(fault.key), fmt::format("{}.{}", method.name, fault.key),
                                fault.message);
        return own.settings;
    }

    /// The tables of an array of tables, none if it is not there.
    std::vector<CheckedTable> repeated(std::string_view name, std::size_t most) {
        const Node* node = document_.find(name);
        if (node == nullptr) return {};
        if (node->kind != Node::Kind::array) {
            errors_.add(
                node->place, name,
                fmt::format("must be an array of tables, write [[{}]], got {}", name, describe(*node)));
            return {};
        }
        std::vector<CheckedTable> all;
        for (const Node& child : node->children) {
            const std::string path = fmt::format("{}.{}", name, all.size());
            if (all.size() == most) {
                errors_.add(child.place, path, fmt::format("is one too many, at most {} are accepted", most));
                break;
            }
            const bool is_table = child.kind == Node::Kind::table;
            if (is_table)
                report_unknown(child, path, spec(name));
            else
                errors_.add(child.place, path, fmt::format("must be a table, got {}", describe(child)));
            all.push_back(check_table(is_table ? &child : nullptr, path, spec(name).keys, errors_));
        }
        return all;
    }

    std::vector<LoadingStage> stages(const CheckedTable& box) {
        const Node* node = document_.find("loading");
        if (node == nullptr || (node->kind == Node::Kind::array && node->children.empty())) {
            errors_.add(node == nullptr ? Place{} : node->place, "loading",
                        "has no stage: write at least one [[loading]] table");
            return {};
        }
        const std::vector<CheckedTable> tables = repeated("loading", most_stages);
        std::vector<LoadingStage> all;
        for (std::size_t k = 0; k < tables.size(); ++k) {
            if (node->children[k].kind == Node::Kind::table) check_stage(tables, k, box, errors_);
            all.push_back(stage_of(tables[k].settings));
        }
        check_course(tables, errors_);
        return all;
    }

    void check_top_level() {
        std::vector<std::string_view> words;
        for (const TableSpec& table : tables_)
            if (!table.name.empty()) words.push_back(table.name);
        for (const KeySpec& key : core_table("").keys) words.push_back(key.name);
        for (const Node& child : document_.children)
            if (std::find(words.begin(), words.end(), child.key) == words.end()) {
                const bool is_table = child.kind == Node::Kind::table || child.kind == Node::Kind::array;
                unknown(child, is_table ? "table" : "key", child.key, words);
            }
    }

    void report_unknown(const Node& node, const std::string& path, const TableSpec& table) {
        std::vector<std::string_view> words;
        for (const KeySpec& key : table.keys) words.push_back(key.name);
        for (const Node& child : node.children)
            if (std::find(words.begin(), words.end(), child.key) == words.end())
                unknown(child, "key", fmt::format("{}.{}", path, child.key), words);
    }

    void unknown(const Node& node, std::string_view what, const std::string& full,
                 std::span<const std::string_view> words) {
        std::string text = fmt::format("unknown {} '{}'", what, shown(full));
        if (const std::string_view meant = suggest(node.key, words); !meant.empty())
            text += fmt::format(", did you mean '{}'?", meant);
        else if (const std::string_view home = home_of(node.key); !home.empty())
            text += fmt::format(", it belongs to [{}]", home);
        else
            text += fmt::format(", known are {}", join(words));
        errors_.add(node.key_place, "", text);
    }

    /// The table that has this key, "" if none.
    std::string_view home_of(std::string_view key) const {
        for (const TableSpec& table : tables_)
            for (const KeySpec& one : table.keys)
                if (one.name == key) return table.name;
        return {};
    }

    const Node& document_;
    const std::filesystem::path& source_;
    std::span<const MethodKeys> methods_;
    NamedFiles files_;
    ErrorList& errors_;
    std::vector<TableSpec> tables_;
};

}  // namespace

Scenario parse_scenario(std::string_view text, const std::filesystem::path& name,
                        std::span<const std::string> overrides, std::span<const MethodKeys> methods,
                        NamedFiles files) {
    Node document = parse_document(text, name.string());
    ErrorList errors(name.string());
    apply_overrides(document, overrides, errors);
    Scenario scenario = Reader(document, name, methods, files, errors).read();
    errors.throw_if_any();
    return scenario;
}

Scenario read_scenario(const std::filesystem::path& path, std::span<const std::string> overrides,
                       std::span<const MethodKeys> methods, NamedFiles files) {
    return parse_scenario(read_document(path, "scenario"), path, overrides, methods, files);
}

}  // namespace softgrain
