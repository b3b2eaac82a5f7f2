#include "bpm/method.hpp"

#include <array>
#include <limits>

#include "bpm/solver.hpp"
#include "common/errors.hpp"
#include "common/refusals.hpp"

namespace softgrain::bpm {
namespace {

// The paper's figure 6: BPM grains yield at 0.05 E of its MPM grains, and at 0.18 F0/<a0> here.
constexpr double attraction_stress_per_modulus = 0.28;

constexpr int default_discs_per_grain = 100;

DiscSizeLaw law_named(const std::string& name) {
    if (name == "uniform") return DiscSizeLaw::uniform;
    if (name == "single") return DiscSizeLaw::single;
    return DiscSizeLaw::uniform_volume;
}

GrainBehaviour behaviour_named(const std::string& name) {
    if (name == "elastic") return GrainBehaviour::elastic;
    if (name == "brittle") return GrainBehaviour::brittle;
    return GrainBehaviour::plastic;
}

std::span<const KeySpec> keys() {
    static const std::array<KeySpec, 19> table{{
        {"grain",
         KeyType::text,
         std::string("plastic"),
         "",
         "what holds a grain's discs together: attraction (plastic), bonds (elastic), bonds that break "
         "(brittle)",
         any_number,
         {"plastic", "elastic", "brittle"}},
        {"discs_per_grain",
         KeyType::integer,
         std::monostate{},
         "",
         "discs in a grain of the mean radius; a larger grain has more discs of the same size; 100 if "
         "neither "
         "this nor disc_diameter is given",
         {1.0, 100000.0}},
        {"disc_diameter", KeyType::number, std::monostate{}, "m",
         "mean disc diameter, instead of discs_per_grain; kept to 2 % in grains of 100 discs", positive},
        {"disc_size_law",
         KeyType::text,
         std::string("uniform_volume"),
         "",
         "what is uniform between the least and the largest disc: its area, or its diameter; or all are "
         "alike",
         any_number,
         {"uniform_volume", "uniform", "single"}},
        {"disc_size_ratio",
         KeyType::number,
         1.625,
         "",
         "largest / smallest disc diameter; above 1.6 the time step follows the smallest disc",
         {1.0, 20.0}},
        {"attraction_stress", KeyType::number, std::monostate{}, "N/m",
         "F0/<a0>: largest attraction of two discs / mean disc diameter; 0.28 E if not given", positive},
        {"attraction_exponent",
         KeyType::number,
         7.0,
         "",
         "gamma of the attraction F0 (a0/r)^gamma; fastest are 7, 2 and 1",
         {least_exponent, largest_exponent}},
        {"attraction_range",
         KeyType::number,
         1.0,
         "a0",
         "largest gap of two discs that attract each other, a0 the sum of their radii",
         {least_range, largest_range}},
        {"tolerance",
         KeyType::number,
         1e-4,
         "disc diameters",
         "contact solver stops when a sweep changes no gap by more",
         {1e-9, 1e-2}},
        {"step", KeyType::number, 0.07, "sqrt(m d / F0)", "time step", {0.0, 0.2, true}},
        {"max_iterations",
         KeyType::integer,
         std::int64_t{1000},
         "",
         "most sweeps of the contact solver in a step",
         {1.0, 1e6}},
        {"over_relaxation",
         KeyType::number,
         1.8,
         "",
         "of the contact solver; rows with friction use 1",
         {0.0, 2.0, true, true}},
        {"rolling_resistance", KeyType::number, 0.0, "",
         "of discs, inside grains and between them: largest torque / (normal force x sum of the radii); acts "
         "with friction only",
         not_negative},
        {"friction_within", KeyType::number, 0.0, "", "Coulomb coefficient between the discs of a grain",
         not_negative},
        {"bond_stiffness", KeyType::number, std::monostate{}, "N/m",
         "force / stretch of a bond; youngs_modulus if not given", positive},
        {"bond_strength", KeyType::number, std::monostate{}, "N/m",
         "largest tension of a bond / mean disc diameter, for brittle grains", positive},
        {"bond_damping", KeyType::number, 0.2, "", "share of a bond's critical damping", {0.0, 1.0}},
        {"bond_reach",
         KeyType::number,
         0.6,
         "disc diameters",
         "discs with a smaller gap are bonded",
         {1e-3, 1.0}},
        {"outline_rho",
         KeyType::number,
         0.3,
         "disc diameters",
         "pores that a disc of this radius cannot enter count as covered by the grain",
         {0.01, 0.5}},
    }};
    return table;
}

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    const auto not_for_aggregates = [&](Feature feature, std::string_view why) {
        refuse(scenario, packing, "bpm", feature, why);
    };
    not_for_aggregates(Feature::periodic_cell, "its contact solver knows only walls");
    not_for_aggregates(Feature::grain_classes, "its discs attract each other alike in every grain");
    not_for_aggregates(Feature::ellipses, "its aggregates begin as discs");
    not_for_aggregates(Feature::wall_friction, "its walls are frictionless");
    not_for_aggregates(Feature::cohesion, "its discs attract each other only within a grain");
    not_for_aggregates(Feature::yield_stress, "its grains yield by bpm.attraction_stress");
    return std::make_unique<BpmSolver>(scenario, packing);
}

}  // namespace

BpmSettings settings_of(const Scenario& scenario) {
    const auto given = scenario.method_settings.find("bpm");
    const Settings settings = given == scenario.method_settings.end() ? Settings(keys()) : given->second;
    if (settings.has("discs_per_grain") && settings.has("disc_diameter"))
        throw InputError("[bpm] has both discs_per_grain and disc_diameter; keep one");
    const auto optional = [&](std::string_view key) {
        return settings.has(key) ? std::optional(settings.number(key)) : std::nullopt;
    };
    const GrainBehaviour behaviour = behaviour_named(settings.text("grain"));
    if (settings.has("bond_strength") != (behaviour == GrainBehaviour::brittle))
        throw InputError(behaviour == GrainBehaviour::brittle
                             ? "[bpm] grain = \"brittle\" needs bond_strength"
                             : "[bpm] bond_strength is for grain = \"brittle\"; leave it out");
    return {.behaviour = behaviour,
            .discs_per_grain = settings.has("discs_per_grain")
                                   ? static_cast<int>(settings.integer("discs_per_grain"))
                                   : default_discs_per_grain,
            .disc_diameter = optional("disc_diameter"),
            .disc_sizes = {law_named(settings.text("disc_size_law")), settings.number("disc_size_ratio")},
            .attraction_stress = settings.has("attraction_stress")
                                     ? settings.number("attraction_stress")
                                     : attraction_stress_per_modulus * scenario.material.youngs_modulus,
            .attraction_exponent = settings.number("attraction_exponent"),
            .attraction_range = settings.number("attraction_range"),
            .tolerance = settings.number("tolerance"),
            .step = settings.number("step"),
            .max_iterations = static_cast<int>(settings.integer("max_iterations")),
            .over_relaxation = settings.number("over_relaxation"),
            .outline_rho = settings.number("outline_rho"),
            .bond_stiffness = optional("bond_stiffness").value_or(scenario.material.youngs_modulus),
            .bond_strength = optional("bond_strength").value_or(0.0),
            .bond_damping = settings.number("bond_damping"),
            .bond_reach = settings.number("bond_reach"),
            .friction_within = settings.number("friction_within"),
            .rolling_resistance = settings.number("rolling_resistance")};
}

const Method& method() {
    static const Method row{"bpm",
                            "bonded particles: grains are aggregates of rigid discs (Nezamabadi et al. 2017)",
                            &keys, &make, "fragments, unless its grains have bonds"};
    return row;
}

}  // namespace softgrain::bpm
