#include "app/bench/stability/draw.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "app/methods.hpp"
#include "common/errors.hpp"
#include "common/io/scenario_checks.hpp"
#include "common/io/scenario_file.hpp"
#include "common/io/scenario_schema.hpp"
#include "common/io/scenario_stages.hpp"
#include "common/packing/generators.hpp"
#include "common/packing/random.hpp"

namespace softgrain::bench {
namespace {

using namespace scenario_io;

constexpr int most_draws = 100000;

/// Values of a key that keep a run short, where its range or its unit does not; drawn by their logarithm if
/// the least is > 0.
struct Bounds {
    std::string_view key;
    double low, high;
};
constexpr std::array bounds{
    Bounds{"random.seed", 0, 1000},
    Bounds{"material.friction", 0, 1},
    Bounds{"material.wall_friction", 0, 1},
    Bounds{"grain_class.aspect_ratio", 1, 2.5},
    Bounds{"grain_class.clump_discs", 2, 5},
    Bounds{"grain_class.clump_elongation", 1, 5},
    Bounds{"packing.count", 1, 25},
    Bounds{"packing.fractal_dimension", 0.5, 3},
    Bounds{"packing.packing_fraction", 0.2, 0.9},
    Bounds{"driven.spacing", 0.2, 3},
    Bounds{"loading.until_strain", -0.1, 0.5},
    Bounds{"loading.until_shear", -0.5, 0.5},
    Bounds{"loading.until_packing_fraction", 0.5, 0.999},
    Bounds{"loading.until_packing_fraction_undeformed", 0.5, 1.3},
    Bounds{"loading.until_stress_ratio", 0.01, 1},
    Bounds{"loading.until_unbalanced", 1e-3, 1},
    Bounds{"loading.strain_amplitude", 1e-4, 0.1},
    Bounds{"loading.stages", 1, 3},
    Bounds{"loading.times", 1, 3},
    Bounds{"loading.inertial_number", 1e-3, 0.3},
    Bounds{"sampling.strain_interval", 0.01, 0.3},
    Bounds{"sampling.frame_every", 1, 5},
    Bounds{"sdem.inertial_number", 1e-3, 0.3},
    Bounds{"bpm.inertial_number", 1e-3, 0.3},
    Bounds{"rigid_dem.inertial_number", 1e-3, 0.3},
    Bounds{"mpm.inertial_number", 1e-3, 0.3},
    Bounds{"sdem.rest_tolerance", 0, 1e-3},
    Bounds{"sdem.safety", 0.05, 1},
    Bounds{"sdem.strain_step", 1e-3, 0.1},
    Bounds{"sdem.tolerance", 1e-9, 1e-2},
    Bounds{"sdem.outline_points", 8, 200},
    Bounds{"rigid_dem.rest_tolerance", 0, 1e-3},
    Bounds{"rigid_dem.safety", 0.05, 1},
    Bounds{"rigid_dem.overlap_limit", 0.01, 2},
    Bounds{"mpm.safety", 0.1, 1},
    Bounds{"mpm.points_across_radius", 4, 8},
    Bounds{"mpm.strain_step", 1e-3, 0.1},
    Bounds{"mpm.time_step", 1, 1e3},
    Bounds{"mpm.max_iterations", 1, 300},
    Bounds{"mpm.penalty", 0, 1000},
    Bounds{"bpm.discs_per_grain", 1, 40},
    Bounds{"bpm.step", 0.01, 0.2},
    Bounds{"bpm.disc_size_ratio", 1, 3},
    Bounds{"bpm.tolerance", 1e-6, 1e-2},
    Bounds{"bpm.max_iterations", 1, 1000},
    Bounds{"bpm.box2d_velocity_iterations", 1, 100},
    Bounds{"bpm.box2d_position_iterations", 1, 100},
};

/// Keys that a stage of a kind cannot be without.
struct Needed {
    LoadingKind kind;
    std::array<std::string_view, 2> keys;
};
constexpr std::array needed{
    Needed{LoadingKind::oedometric, {"wall", "until_strain"}},
    Needed{LoadingKind::biaxial, {"lateral_stress", "until_strain"}},
    Needed{LoadingKind::isotropic, {"until_strain", ""}},
    Needed{LoadingKind::uniaxial, {"until_strain", ""}},
    Needed{LoadingKind::shear, {"until_shear", ""}},
    Needed{LoadingKind::gradient, {"gradient_xy", "duration"}},
    Needed{LoadingKind::hold, {"duration", ""}},
    Needed{LoadingKind::stress, {"pressure", "duration"}},
    Needed{LoadingKind::probe, {"direction", "strain_amplitude"}},
    Needed{LoadingKind::repeat, {"stages", ""}},
};

/// Keys that ask for what some methods refuse.
struct FeatureKey {
    std::string_view key;
    Feature feature;
};
constexpr std::array features{
    FeatureKey{"friction", Feature::friction},     FeatureKey{"wall_friction", Feature::wall_friction},
    FeatureKey{"cohesion", Feature::cohesion},     FeatureKey{"yield_stress", Feature::yield_stress},
    FeatureKey{"aspect_ratio", Feature::ellipses}, FeatureKey{"clump", Feature::clumps},
    FeatureKey{"clump_discs", Feature::clumps},
};

/// One attempt at a scenario.
class Draw {
  public:
    Draw(Random& random, const Method& method) : random_(random), method_(method) {
        length_ = power(-3, 1);
        modulus_ = power(-2, 4);
        density_ = power(-2, 3);
        time_ = length_ * std::sqrt(density_ / modulus_);  // of a wave through a grain
    }

    std::string text() {
        periodic_ = wants(Feature::periodic_cell, 0.3);
        add_table("random", {"seed"});
        add_table("material", {"youngs_modulus", "density"}, 0.3);
        if (wants(Feature::grain_classes, 0.3)) add_classes();
        add_packing();
        add_table("sampling", {"strain_interval"}, 0.4);
        if (wants(Feature::driven_grains, 0.15)) add_driven();
        for (int stages = 1 + whole(0, 3); stages > 0; --stages) add_stage();
        for (const MethodKeys& method : method_keys())
            if (method.name == method_.name) add_keys(method.name, method.keys, {}, 0.15);
        return std::move(text_);
    }

  private:
    bool chance(double share) { return random_.unit() < share; }
    /// What the method refuses is rare, so that most scenarios run.
    bool wants(Feature feature, double share) {
        const bool refused =
            std::ranges::find(method_.refusals, feature, &Refusal::feature) != method_.refusals.end();
        return chance(refused ? 0.01 : share);
    }
    double power(double low, double high) { return std::pow(10.0, random_.between(low, high)); }
    int whole(int low, int high) {  // high not included
        return low + static_cast<int>(random_.unit() * static_cast<double>(high - low));
    }
    template <class List>
    auto one_of(const List& list) {
        return list[static_cast<std::size_t>(whole(0, static_cast<int>(list.size())))];
    }

    static bool is_in(const std::vector<std::string_view>& list, std::string_view key) {
        return std::ranges::find(list, key) != list.end();
    }

    void add_line(std::string_view key, const std::string& value) {
        text_ += fmt::format("{} = {}\n", key, value);
    }

    void add_table(std::string_view name, const std::vector<std::string_view>& always, double share = 0.2) {
        add_keys(name, core_table(name).keys, always, share);
    }
    void add_keys(std::string_view table, std::span<const KeySpec> keys,
                  const std::vector<std::string_view>& always, double share) {
        text_ += fmt::format("\n[{}]\n", table);
        for (const KeySpec& key : keys)
            if (is_in(always, key.name) || is_wanted(key, share)) add_key(table, key);
    }
    bool is_wanted(const KeySpec& key, double share) {
        const auto* row = std::ranges::find(features, key.name, &FeatureKey::key);
        return row == features.end() ? chance(share) : wants(row->feature, share);
    }
    void add_key(std::string_view table, const KeySpec& key) {
        if (const auto value = value_of(table, key)) add_line(key.name, *value);
    }
    void add_key(std::string_view table, std::string_view name) {
        add_key(table, *std::ranges::find(core_table(table).keys, name, &KeySpec::name));
    }

    std::optional<std::string> value_of(std::string_view table, const KeySpec& key) {
        switch (key.type) {
            case KeyType::boolean:
                return chance(0.5) ? "true" : "false";
            case KeyType::text:
                if (!key.choices.empty()) return fmt::format("\"{}\"", one_of(key.choices));
                return free_text(key.name);
            case KeyType::integer:
                return fmt::format("{}", std::llround(number(table, key)));
            case KeyType::number:
                break;
        }
        return fmt::format("{:.9e}", number(table, key));
    }

    /// Texts of any form have no choices in the schema.
    std::optional<std::string> free_text(std::string_view name) {
        if (name == "measures")
            return one_of(std::array<std::string, 3>{
                "\"grains, forces, chains\"", "\"pair_correlation, tessellation\"", "\"tessellation\""});
        if (name == "clump")
            return one_of(std::array<std::string, 2>{"\"0 0 1, 1 0 1, 0.5 0.8 1\"", "\"0 0 2, 1.5 0 1\""});
        return std::nullopt;
    }

    double number(std::string_view table, const KeySpec& key) {
        const Range& range = key.range;
        const bool has_bounds = std::isfinite(range.min) && std::isfinite(range.max);
        // The ends of a range are where formulas break.
        if (has_bounds && chance(0.1) && !range.open_min && range.min >= 0.0 && range.max <= 1.0)
            return chance(0.5) || range.open_max ? range.min : range.max;
        const std::string name = fmt::format("{}.{}", table, key.name);
        if (const auto* own = std::ranges::find(bounds, name, &Bounds::key); own != bounds.end()) {
            if (own->low <= 0.0) return chance(0.2) ? 0.0 : random_.between(own->low, own->high);
            return own->low * std::pow(own->high / own->low, random_.unit());
        }
        if (const auto scale = in_units(key)) return *scale;
        if (has_bounds) return random_.between(range.min, range.max);
        const double* given = std::get_if<double>(&key.default_value);
        const double about = given != nullptr && *given != 0.0 ? *given : 1.0;
        return (range.min < 0.0 && chance(0.5) ? -1.0 : 1.0) * about * power(-1.5, 1.5);
    }

    /// A quantity with a unit, about the scenario's own.
    std::optional<double> in_units(const KeySpec& key) {
        const bool is_signed = key.range.min < 0.0;
        const double sign = is_signed && chance(0.5) ? -1.0 : 1.0;
        if (key.name == "youngs_modulus") return modulus_ * (chance(0.1) ? power(-3, 3) : power(-0.5, 0.5));
        if (key.unit == "N/m") return sign * modulus_ * power(-4, -0.5);
        if (key.unit == "kg/m^2") return density_ * power(-0.5, 0.5);
        if (key.unit == "m") return sign * length_ * power(-0.5, 0.5);
        if (key.unit == "s") return time_ * power(0.5, 3);
        if (key.unit == "1/s") return sign / time_ * power(-3, -1);
        if (key.unit == "m/s") return sign * length_ / time_ * power(-3, -1);
        if (key.unit == "m/s^2") return sign * length_ / (time_ * time_) * power(-6, -2);
        return std::nullopt;
    }

    void add_classes() {
        for (int count = whole(1, 4); count > 0; --count) {
            text_ += "\n[[grain_class]]\n";
            for (const KeySpec& key : core_table("grain_class").keys)
                if (is_wanted(key, 0.3)) add_key("grain_class", key);
        }
    }

    void add_packing() {
        const std::string_view law = one_of(size_law_names);
        const bool region = chance(0.1), sized = region || chance(0.3);
        const auto generator = region ? Generator::random_sequential : static_cast<Generator>(whole(0, 5));
        text_ += fmt::format("\n[packing]\nsize_law = \"{}\"\ngenerator = \"{}\"\n", law,
                             generator_names[static_cast<std::size_t>(generator)]);
        add_key("packing", "count");
        const double mean = length_ * power(-0.3, 0.3), ratio = power(0, chance(0.1) ? 1.5 : 0.5);
        add_line("radius_mean", fmt::format("{:.9e}", mean));
        add_line("radius_min", fmt::format("{:.9e}", mean / ratio));
        add_line("radius_max", fmt::format("{:.9e}", mean * ratio));
        add_line("radius_deviation", fmt::format("{:.9e}", mean * power(-2, 0)));
        if (generator == Generator::random_sequential ? !region : chance(0.3))
            add_line(
                "packing_fraction",
                fmt::format("{:.6f}", random_.between(0.05, generator == Generator::growth ? 0.8 : 0.4)));
        for (const std::string_view key : {"fractal_dimension", "small_share"})
            if (chance(0.3)) add_key("packing", key);
        const double side = mean * ratio * random_.between(4.0, 40.0);
        const double height = side * power(-0.7, 0.7);
        if (region) {
            add_line("region", "\"disc\"");
            add_line("region_radius",
                     fmt::format("{:.9e}", std::min(side, height) * random_.between(0.1, 0.5)));
        }
        text_ += "\n[box]\n";
        if (sized) {
            add_line("width", fmt::format("{:.9e}", side));
            add_line("height", fmt::format("{:.9e}", height));
        }
        if (periodic_) add_line("periodic", "true");
        for (const std::string_view key : {"gravity_x", "gravity_y"})
            if (!periodic_ && chance(0.1)) add_key("box", key);
    }

    void add_driven() {
        text_ += "\n[[driven]]\n";
        const bool ring = chance(0.5);
        add_line("kind", ring ? "\"ring\"" : "\"row\"");
        for (const std::string_view key : {"disc_radius", "spacing"}) add_key("driven", key);
        if (ring)
            for (const std::string_view key : {"center_x", "center_y", "radius", "spin"})
                add_key("driven", key);
        else
            for (const std::string_view key :
                 {"from_x", "from_y", "to_x", "to_y", "velocity_x", "velocity_y"})
                add_key("driven", key);
    }

    void add_stage() {
        const auto kind = static_cast<LoadingKind>(whole(0, static_cast<int>(loading_kind_names.size())));
        text_ +=
            fmt::format("\n[[loading]]\nkind = \"{}\"\n", loading_kind_names[static_cast<std::size_t>(kind)]);
        const auto& always = std::ranges::find(needed, kind, &Needed::kind)->keys;
        const bool by_inertia = chance(0.5);
        const bool has_rate = is_for("strain_rate", kind);
        for (const KeySpec& key : core_table("loading").keys) {
            if (key.name == "kind" || !is_for(key.name, kind)) continue;
            // An end by time too, so that a stage whose grains never reach its end has one.
            const bool is_rate = key.name == "strain_rate" || key.name == "inertial_number";
            const bool wanted = is_rate ? has_rate && by_inertia == (key.name == "inertial_number")
                                : std::ranges::find(always, key.name) != always.end() ||
                                        (key.name == "duration" && chance(0.7))
                                    ? true
                                    : chance(0.12);
            if (wanted) add_key("loading", key);
        }
    }

    Random& random_;
    const Method& method_;
    std::string text_;
    double length_, modulus_, density_, time_;
    bool periodic_ = false;
};

}  // namespace

DrawnScenario draw_scenario(std::uint64_t seed, std::string_view method) {
    Random random(seed);
    const Method& row = find_method(method);
    DrawnScenario drawn;
    for (int k = 0; k < most_draws; ++k) {
        drawn.text = Draw(random, row).text();
        try {
            parse_scenario(drawn.text, "drawn.toml", {}, method_keys());
            return drawn;
        } catch (const InputError& error) {
            drawn.refused.emplace_back(error.what());
        }
    }
    throw std::logic_error(fmt::format("seed {}: the reader refuses all of {} scenarios, as in: {}", seed,
                                       most_draws, drawn.refused.back()));
}

}  // namespace softgrain::bench
