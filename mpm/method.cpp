#include "mpm/method.hpp"

#include <fmt/format.h>

#include <array>

#include "common/errors.hpp"
#include "common/refusals.hpp"
#include "mpm/solver.hpp"

namespace softgrain::mpm {
namespace {

constexpr int points_per_cell = 2;  // along a side

LawKind law_named(const std::string& name) {
    if (name == "saint_venant_kirchhoff") return LawKind::saint_venant_kirchhoff;
    if (name == "linear") return LawKind::linear;
    return LawKind::neo_hookean;
}

std::vector<KeyFault> faults_of(const Settings& settings) {
    std::vector<KeyFault> faults;
    if (settings.integer("points_across_radius") % points_per_cell != 0)
        faults.push_back({"points_across_radius", "must be even: a grid cell has 2 x 2 points"});
    if (settings.text("contact") == "common_grid" && settings.text("driver") != "explicit")
        faults.push_back({"contact", "= \"common_grid\" needs driver = \"explicit\""});
    if (settings.boolean("mean_dilatation") && law_named(settings.text("law")) != LawKind::neo_hookean)
        faults.push_back({"mean_dilatation", "is for law = \"neo_hookean\"; leave it out"});
    return faults;
}

std::span<const KeySpec> keys() {
    static const std::array<KeySpec, 12> table{{
        {"law",
         KeyType::text,
         std::string("neo_hookean"),
         "",
         "what grains are made of; material.yield_stress makes neo-Hookean grains elasto-plastic; \"linear\" "
         "is for "
         "small strains without rotation only",
         any_number,
         {"neo_hookean", "saint_venant_kirchhoff", "linear"}},
        {"driver",
         KeyType::text,
         std::string("implicit"),
         "",
         "\"implicit\" is dynamics by Euler's implicit method; \"quasi_static\" finds equilibria, without "
         "friction; \"explicit\" is dynamics by leap-frog",
         any_number,
         {"implicit", "quasi_static", "explicit"}},
        {"contact",
         KeyType::text,
         std::string("surface"),
         "",
         "\"common_grid\" is contact at the nodes of a grid that grains share, which keeps them apart by a "
         "cell; for comparison only, with driver = \"explicit\"",
         any_number,
         {"surface", "common_grid"}},
        {"points_across_radius",
         KeyType::integer,
         std::int64_t{16},
         "",
         "material points across a radius, two in a grid cell: 16 is within 1 % in stress, 32 within 0.3 %",
         {4.0, 128.0}},
        {"mean_dilatation", KeyType::boolean, false, "",
         "take the pressure at the mean dilatation of each grid cell: for nu above 0.495"},
        {"penalty",
         KeyType::number,
         0.0,
         "E/(1 - nu^2) / grid spacing",
         "stiffness of contact: surfaces overlap by pressure / stiffness; 0: 200, or 20 if driver = "
         "\"explicit\"",
         {0.0, 1e5}},
        {"tolerance",
         KeyType::number,
         1e-5,
         "largest force of a node",
         "largest unbalanced force of a node that counts as equilibrium",
         {1e-10, 1e-2}},
        {"max_iterations",
         KeyType::integer,
         std::int64_t{200},
         "",
         "most iterations of Newton's method before a step is halved",
         {1.0, 1e5}},
        {"strain_step",
         KeyType::number,
         0.004,
         "",
         "largest motion of a wall in a step, as a share of the box",
         {1e-6, 0.1}},
        {"time_step",
         KeyType::number,
         50.0,
         "radius of the smallest grain / sqrt(E/rho)",
         "largest step of implicit dynamics",
         {1e-3, 1e6}},
        {"safety",
         KeyType::number,
         Value(),
         "",
         "time step of explicit dynamics / largest stable one; by itself 0.8, or 0.5 where nothing damps: "
         "energy is then kept to 3 % over a million steps",
         {1e-3, 1.0}},
        {"damping", KeyType::number, 0.5, "sqrt(E/rho) / radius of the smallest grain",
         "damping of what grains move beside their rigid motion, in explicit dynamics", not_negative},
    }};
    return table;
}

constexpr std::array refusals{
    Refusal{Feature::periodic_cell, "its contacts know only walls"},
    Refusal{Feature::clumps, "its grains are discs or ellipses"},
    Refusal{Feature::cohesion, "its surfaces only repel each other"},
    Refusal{Feature::driven_grains, "its grains are deformable"},
};

std::unique_ptr<Solver> make(const Scenario& scenario, const Packing& packing) {
    refuse(scenario, packing, "mpm", refusals);
    const bool rubs = scenario.material.friction > 0.0 || scenario.material.wall_friction > 0.0;
    if (rubs && settings_of(scenario).driver == Driver::quasi_static)
        throw InputError(
            "mpm.driver = \"quasi_static\" finds equilibria, and with friction there is more than one; set "
            "material.friction and material.wall_friction to 0 or use mpm.driver = \"implicit\"");
    return std::make_unique<MpmSolver>(scenario, packing);
}

}  // namespace

MpmSettings settings_of(const Scenario& scenario) {
    const auto given = scenario.method_settings.find("mpm");
    const Settings settings = given == scenario.method_settings.end() ? Settings(keys()) : given->second;
    for (const KeyFault& fault : faults_of(settings))
        throw InputError(fmt::format("mpm.{} {}", fault.key, fault.message));
    MpmSettings s;
    s.law = law_named(settings.text("law"));
    s.cells = static_cast<int>(settings.integer("points_across_radius")) / points_per_cell;
    const std::string driver = settings.text("driver");
    s.driver = driver == "explicit"   ? Driver::explicit_steps
               : driver == "implicit" ? Driver::implicit
                                      : Driver::quasi_static;
    s.strain_step = settings.number("strain_step");
    s.time_step = settings.number("time_step");
    s.equilibrium.tolerance = settings.number("tolerance");
    s.equilibrium.most_iterations = static_cast<int>(settings.integer("max_iterations"));
    const double penalty = settings.number("penalty");
    s.equilibrium.penalty = penalty > 0.0 ? penalty : 200.0;
    s.motion.penalty = penalty > 0.0 ? penalty : 20.0;
    s.equilibrium.mean_dilatation = s.motion.mean_dilatation = settings.boolean("mean_dilatation");
    s.motion.damping = settings.number("damping");
    s.motion.safety = settings.has("safety") ? settings.number("safety") : s.motion.damping > 0.0 ? 0.8 : 0.5;
    if (settings.text("contact") == "common_grid") s.motion.common_grid.emplace();
    return s;
}

const Method& method() {
    static const Method row{.name = "mpm",
                            .title = "material points: resolved grains, the reference of the others",
                            .keys = &keys,
                            .make = &make,
                            .not_given = "fragments",
                            .faults = &faults_of,
                            .refusals = refusals,
                            .inertial_number = 1e-3};
    return row;
}

}  // namespace softgrain::mpm
