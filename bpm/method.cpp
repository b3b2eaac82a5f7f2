#include "bpm/method.hpp"

#include <fmt/format.h>

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
constexpr double default_step = 0.07;
// Box2D's error follows the step, not its iterations.
constexpr double default_box2d_step = 0.01;
constexpr int default_velocity_iterations = 8, default_position_iterations = 3;

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

/// Of engine = "box2d": what it does not have.
void add_box2d_faults(const Settings& settings, std::vector<KeyFault>& faults) {
    constexpr const char* cure = "leave it out, or use engine = \"nscd\"";
    if (behaviour_named(settings.text("grain")) != GrainBehaviour::plastic)
        faults.push_back(
            {"grain", fmt::format("needs bonds, which engine = \"box2d\" does not have; {}", cure)});
    for (const std::string_view key : {"rolling_resistance", "friction_within"})
        if (settings.number(key) > 0.0)
            faults.push_back({key, fmt::format("is not for engine = \"box2d\"; {}", cure)});
}

std::vector<KeyFault> faults_of(const Settings& settings) {
    std::vector<KeyFault> faults;
    const auto only_for = [&](std::string_view key, bool wanted, std::string_view use) {
        if (settings.has(key) && !wanted)
            faults.push_back({key, fmt::format("is for {}; leave it out", use)});
    };
    const GrainBehaviour behaviour = behaviour_named(settings.text("grain"));
    const bool box2d = settings.text("engine") == "box2d";
    if (settings.has("discs_per_grain")) only_for("disc_diameter", false, "grains without discs_per_grain");
    only_for("bond_stiffness", behaviour != GrainBehaviour::plastic, "grain = \"elastic\" or \"brittle\"");
    only_for("bond_strength", behaviour == GrainBehaviour::brittle, "grain = \"brittle\"");
    if (behaviour == GrainBehaviour::brittle && !settings.has("bond_strength"))
        faults.push_back({"grain", "= \"brittle\" needs bond_strength"});
    for (const std::string_view key : {"box2d_velocity_iterations", "box2d_position_iterations"})
        only_for(key, box2d, "engine = \"box2d\"");
    if (box2d) add_box2d_faults(settings, faults);
    return faults;
}

std::span<const KeySpec> keys() {
    static const std::array<KeySpec, 22> table{{
        {"engine",
         KeyType::text,
         std::string("nscd"),
         "",
         "what solves the contacts of the discs: contact dynamics (nscd) or Box2D (plastic grains only)",
         any_number,
         {"nscd", "box2d"}},
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
         "F0/<a0> of plastic grains: largest attraction of two discs / mean disc diameter; 0.28 E if not "
         "given",
         positive},
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
        {"step",
         KeyType::number,
         std::monostate{},
         "sqrt(m d / F0)",
         "time step; 0.07 if not given, 0.01 for engine = \"box2d\"",
         {0.0, 0.2, true}},
        {"box2d_velocity_iterations",
         KeyType::integer,
         std::monostate{},
         "",
         "for engine = \"box2d\", 8 if not given",
         {1.0, 1e4}},
        {"box2d_position_iterations",
         KeyType::integer,
         std::monostate{},
         "",
         "for engine = \"box2d\", 3 if not given",
         {1.0, 1e4}},
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

/// Impulses tremble: the unbalanced force of a packing at rest is 0.3 to 0.9.
constexpr double trembling = 1.0;

constexpr std::array refusals{
    Refusal{Feature::periodic_cell, "its contact solver knows only walls"},
    Refusal{Feature::grain_classes, "its discs attract each other alike in every grain"},
    Refusal{Feature::ellipses, "its aggregates begin as discs"},
    Refusal{Feature::clumps, "its aggregates begin as discs"},
    Refusal{Feature::wall_friction, "its walls are frictionless"},
    Refusal{Feature::cohesion, "its discs attract each other only within a grain"},
    Refusal{Feature::yield_stress, "its grains yield by bpm.attraction_stress"},
    Refusal{Feature::driven_grains, "its grains are aggregates"},
};

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    refuse(scenario, packing, "bpm", refusals);
    return std::make_unique<BpmSolver>(scenario, packing);
}

}  // namespace

BpmSettings settings_of(const Scenario& scenario) {
    const auto given = scenario.method_settings.find("bpm");
    const Settings settings = given == scenario.method_settings.end() ? Settings(keys()) : given->second;
    for (const KeyFault& fault : faults_of(settings))
        throw InputError(fmt::format("bpm.{} {}", fault.key, fault.message));
    const auto optional = [&](std::string_view key) {
        return settings.has(key) ? std::optional(settings.number(key)) : std::nullopt;
    };
    const GrainBehaviour behaviour = behaviour_named(settings.text("grain"));
    const Engine engine = settings.text("engine") == "box2d" ? Engine::box2d : Engine::nscd;
    const double step = optional("step").value_or(engine == Engine::nscd ? default_step : default_box2d_step);
    const auto count = [&](std::string_view key, int otherwise) {
        return settings.has(key) ? static_cast<int>(settings.integer(key)) : otherwise;
    };
    return {.engine = engine,
            .behaviour = behaviour,
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
            .step = step,
            // With any engine the grains are placed by contact dynamics.
            .placing_step = engine == Engine::nscd ? step : default_step,
            .max_iterations = static_cast<int>(settings.integer("max_iterations")),
            .over_relaxation = settings.number("over_relaxation"),
            .outline_rho = settings.number("outline_rho"),
            .bond_stiffness = optional("bond_stiffness").value_or(scenario.material.youngs_modulus),
            .bond_strength = optional("bond_strength").value_or(0.0),
            .bond_damping = settings.number("bond_damping"),
            .bond_reach = settings.number("bond_reach"),
            .friction_within = settings.number("friction_within"),
            .rolling_resistance = settings.number("rolling_resistance"),
            .velocity_iterations = count("box2d_velocity_iterations", default_velocity_iterations),
            .position_iterations = count("box2d_position_iterations", default_position_iterations)};
}

const Method& method() {
    static const Method row{
        "bpm",    "bonded particles: grains are aggregates of rigid discs (Nezamabadi et al. 2017)",
        &keys,    &make,
        "",       &faults_of,
        refusals, trembling};
    return row;
}

}  // namespace softgrain::bpm
